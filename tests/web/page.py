"""The page in a headless browser, in front of the program itself: page.py KERRD FOLDER, where screenshots go.

Skipped, with the reason, where Playwright for Python, Chromium or a Vulkan device is missing."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest
import urllib.request

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / 'http'))
import daemon  # noqa: E402

BUDGET = 300_000  # bytes of all that a visit to every view loads, as sent, without pictures
AT_REST = '#stage[data-final=true]'
FINE = '#stage[data-final=true][data-samples="2"]'
VIEWS = ('lensing', 'orbits', 'physics', 'scale')
CHROMIUM = shutil.which('chromium') or shutil.which('chromium-browser')
# No GPU and no WebGL: the page must need neither.
FLAGS = ['--no-sandbox', '--disable-gpu', '--disable-3d-apis', '--disable-quic', '--no-first-run', '--disable-background-networking',
         '--disable-component-update', '--disable-sync']


def value(cell):
    """Of a number as the page writes it in English: 1,234.5 or 6.3 × 10⁻⁵."""
    superscripts = str.maketrans('⁰¹²³⁴⁵⁶⁷⁸⁹⁻', '0123456789-')
    return float(cell.replace(',', '').replace('−', '-').replace(' × 10', 'e').translate(superscripts))


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.daemon = daemon.Daemon()
        cls.base = f'http://127.0.0.1:{cls.daemon.port}/'
        cls.playwright = sync_playwright().start()
        cls.browser = cls.playwright.chromium.launch(executable_path=CHROMIUM, args=FLAGS)

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.playwright.stop()
        code = cls.daemon.stop()
        if code:
            raise AssertionError(f'kerrd exited with {code}')

    def setUp(self):
        self.complaints, self.requests, self.contexts, self.expected = [], [], [], ''

    def tearDown(self):
        for context in self.contexts:
            context.close()
        self.assertEqual([c for c in self.complaints if not self.expected or self.expected not in c], [])
        for request in self.requests:
            self.assertTrue(request.url.startswith((self.base, 'blob:' + self.base)), request.url)

    def open(self, fragment='lang=en', wait=AT_REST, **options):
        options.setdefault('viewport', {'width': 1000, 'height': 640})
        context = self.browser.new_context(**options)
        self.contexts.append(context)
        page = context.new_page()
        page.on('console', lambda m: self.complaints.append(f'{m.type}: {m.text}') if m.type in ('error', 'warning') else None)
        page.on('pageerror', lambda e: self.complaints.append(str(e)))
        page.on('request', lambda r: self.requests.append(r))
        page.goto(self.base + '#' + fragment)
        page.wait_for_selector(wait, timeout=60000, state='attached')
        return page

    def shot(self, page, name, **options):
        SHOTS.mkdir(exist_ok=True)
        page.screenshot(path=SHOTS / f'{name}.png', **options)

    def pixels(self, page):
        return page.evaluate('''async () => {
            const picture = document.getElementById('picture'), { naturalWidth: width, naturalHeight: height } = picture;
            const context = new OffscreenCanvas(width, height).getContext('2d');
            context.drawImage(picture, 0, 0);
            const hash = await crypto.subtle.digest('SHA-256', context.getImageData(0, 0, width, height).data);
            return `${width}x${height} ` + [...new Uint8Array(hash)].map(b => b.toString(16).padStart(2, '0')).join('');
        }''')

    def drawn(self, page, canvas):
        return page.locator(canvas).evaluate('''canvas => {
            const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d');
            copy.drawImage(canvas, 0, 0);
            const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
            let coloured = 0, hash = 0;
            for (let i = 0; i < data.length; i += 4) {
                const [r, g, b] = data.slice(i, i + 3), most = Math.max(r, g, b);
                coloured += most - Math.min(r, g, b) > 50;
                hash = (hash * 31 + r + 7 * g + 13 * b) % 1000003;
            }
            return { coloured, hash };
        }''')

    def field(self, page, path):
        return page.locator(f'[data-path="{path}"] input[type=number]').input_value()

    def drag(self, page, right, down):
        box = page.locator('#stage').bounding_box()
        x, y = box['x'] + box['width'] / 2, box['y'] + box['height'] / 2
        page.mouse.move(x, y)
        page.mouse.down()
        for step in range(1, 9):
            page.mouse.move(x + right * step / 8, y + down * step / 8)
        page.mouse.up()
        page.wait_for_selector(AT_REST)

    def open_groups(self, page):
        page.evaluate('() => { for (const d of document.querySelectorAll("details")) d.open = true; }')

    def physics(self, name, **parameters):
        query = '&'.join(f'{k}={v}' for k, v in parameters.items())
        with urllib.request.urlopen(f'{self.base}v1/physics/{name}?{query}') as answer:
            return json.load(answer)['values']

    def test_it_loads_and_is_light(self):
        page = self.open(wait=FINE)
        self.shot(page, 'lensing')
        with urllib.request.urlopen(self.base + 'v1/schema') as answer:
            schema = json.load(answer)['properties']
        paths = {f'{section}.{name}' for section, spec in schema.items() for name in spec.get('properties', {})}
        shown = set(page.locator('[data-path]').evaluate_all('all => all.map(n => n.dataset.path)'))
        self.assertEqual(shown, (paths | {'time'}) - {'image.width', 'image.height'})
        words = page.inner_text('#accuracy-words')
        self.assertIn('traced again in double precision', words)
        told = [value(x) for x in re.search('off by (.+?) of themselves in the median, (.+?) at worst', words).groups()]
        last = [r for r in self.requests if '/frame.png' in r.url][-2].response().headers['kerrd-accuracy']  # one is still awaited
        for got, name in zip(told, ('median', 'worst')):
            self.assertAlmostEqual(got / float(re.search(rf'{name}=(\S+)', last)[1]), 1, delta=0.06)
        self.assertGreater(page.locator('#approximations li').count(), 3)
        self.assertGreater(page.locator('#timings tr').count(), 4)
        self.assertEqual(page.evaluate('() => document.createElement("canvas").getContext("webgl")'), None, 'the flag took WebGL away')

        first = page.evaluate('''() => {
            const opened = performance.getEntriesByType('resource').find(e => e.name.endsWith('/v1/sessions')).startTime;
            const shown = performance.getEntriesByName('first-picture')[0].startTime;
            return [shown, shown - opened].map(Math.round);
        }''')
        print(f'first picture {first[0]} ms after navigation, {first[1]} ms after the session was asked for')
        at_first = sum(r.sizes()['responseBodySize'] + r.sizes()['responseHeadersSize'] for r in self.requests
                       if r.url.startswith(self.base) and '/frame.png' not in r.url and r.response())
        print(f'{at_first} bytes for the first view')
        for view in VIEWS[1:]:
            page.click(f'nav [data-view={view}]')
            page.wait_for_timeout(1500)
        sizes = {}
        for request in self.requests:
            if request.url.startswith(self.base) and '/frame.png' not in request.url and request.response():
                sizes[request.url] = request.sizes()['responseBodySize'] + request.sizes()['responseHeadersSize']
        own = sum(n for url, n in sizes.items() if '/v1/' not in url)
        print(f'{len(sizes)} requests, {sum(sizes.values())} bytes for all views, {own} of them the page itself')
        self.assertLess(sum(sizes.values()), BUDGET)

    def test_a_drag_changes_the_picture(self):
        page = self.open()
        before = self.pixels(page)
        self.drag(page, 0, -80)
        self.assertGreater(float(self.field(page, 'camera.inclination_deg')), 90)
        self.assertNotEqual(self.pixels(page), before)
        self.drag(page, 60, 0)
        self.assertNotEqual(float(self.field(page, 'camera.azimuth_deg')), 0)

    def test_a_picture_at_rest_costs_nothing(self):
        for width in (1280, 1000, 900, 700):
            page = self.open(wait=FINE, viewport={'width': width, 'height': 700})
            page.wait_for_timeout(500)
            before = len(self.requests)
            page.wait_for_timeout(1500)
            self.assertEqual([r.url for r in self.requests[before:]], [], width)

    def test_wheel_keys_and_buttons(self):
        page = self.open()
        page.hover('#stage')
        page.mouse.wheel(0, 300)
        page.wait_for_selector(AT_REST)
        far = float(self.field(page, 'camera.field_m'))
        self.assertGreater(far, 50)
        page.focus('#stage')
        page.keyboard.press('+')
        self.assertLess(float(self.field(page, 'camera.field_m')), far)
        page.keyboard.press('ArrowUp')
        page.keyboard.press('Shift+ArrowRight')
        self.assertEqual((self.field(page, 'camera.inclination_deg'), self.field(page, 'camera.azimuth_deg')), ('80', '10'))
        for key, end in (('ArrowUp', '0'), ('ArrowDown', '180')):
            for _ in range(20):
                page.keyboard.press('Shift+' + key)
            self.assertEqual(self.field(page, 'camera.inclination_deg'), end)
        page.click('#nearer')
        self.assertLess(float(self.field(page, 'camera.field_m')), far / 1.2)
        page.click('#reset')
        page.wait_for_selector(AT_REST)
        self.assertEqual((self.field(page, 'camera.field_m'), self.field(page, 'camera.inclination_deg')), ('46', '82'))
        page = self.open(viewport={'width': 700, 'height': 600})
        page.hover('#stage')
        page.mouse.wheel(0, 300)
        self.assertTrue(daemon.eventually(lambda: self.field(page, 'camera.field_m') != '46'))
        self.assertEqual(page.evaluate('scrollY'), 0)

    def test_pinch(self):
        page = self.open(has_touch=True)
        page.evaluate('''() => {
            const stage = document.getElementById('stage');
            stage.setPointerCapture = () => {};
            const send = (type, pointerId, x) => stage.dispatchEvent(new PointerEvent(type, { pointerId, clientX: x, clientY: 200, bubbles: true }));
            send('pointerdown', 1, 200); send('pointerdown', 2, 300);
            send('pointermove', 2, 400); send('pointerup', 1, 200); send('pointerup', 2, 400);
        }''')
        self.assertEqual(float(self.field(page, 'camera.field_m')), 23)

    def test_a_link_restores_the_view(self):
        page = self.open()
        self.drag(page, 30, 40)
        self.open_groups(page)
        page.select_option('[data-path="sky.model"] select', 'grid')
        page.check('#over-shadow')
        page.wait_for_selector(FINE)
        page.wait_for_timeout(300)
        again = self.open(page.url.split('#')[1], FINE)
        self.assertIn('camera.inclination_deg=', again.url)
        for path in ('camera.inclination_deg', 'camera.azimuth_deg'):
            self.assertEqual(self.field(again, path), self.field(page, path))
        self.assertTrue(again.is_checked('#over-shadow'))
        self.assertEqual(self.pixels(again), self.pixels(page))

    def test_presets_and_refusals(self):
        page = self.open()
        before = self.pixels(page)
        page.select_option('#preset', 'gargantua')
        self.assertTrue(daemon.eventually(lambda: self.field(page, 'camera.r') == '74.1'))
        page.wait_for_selector(AT_REST)
        self.assertEqual((self.field(page, 'spacetime.spin'), self.field(page, 'camera.r')), ('0.999', '74.1'))
        self.assertIn('James', page.inner_text('#preset-help'))
        self.assertNotEqual(self.pixels(page), before)
        self.expected = '422'
        page.fill('[data-path="camera.r"] input[type=number]', '1.5')
        page.keyboard.press('Enter')
        page.wait_for_selector('[data-path="camera.r"] .fault:not([hidden])')
        self.assertIn('ergosphere', page.inner_text('[data-path="camera.r"] .fault'))
        page.fill('[data-path="camera.r"] input[type=number]', '30')
        page.keyboard.press('Enter')
        page.wait_for_selector(AT_REST)
        self.assertEqual(page.locator('.fault:not([hidden]):not(:empty)').count(), 0)

    def test_the_scene_can_be_taken_away(self):
        page = self.open('lang=en&spacetime.spin=-0.5')
        self.open_groups(page)
        page.select_option('#save-size', '1280x720')
        scene = json.loads(page.input_value('#scene-text'))
        self.assertEqual(scene, {'spacetime': {'spin': -0.5}, 'image': {'width': 1280, 'height': 720}})
        page.select_option('#scene-form', 'curl')
        command = page.input_value('#scene-text')
        answer = subprocess.run(command.replace('-o kerrd.png', '-s -o -'), shell=True, capture_output=True, timeout=60)
        self.assertEqual(answer.stdout[:8], b'\x89PNG\r\n\x1a\n', command)
        with page.expect_download() as download:
            page.click('#save')
        saved = pathlib.Path(download.value.path()).read_bytes()
        self.assertEqual((saved[:4], saved[16:24]), (b'\x89PNG', (1280).to_bytes(4, 'big') + (720).to_bytes(4, 'big')))

    def test_both_languages(self):
        english, italian = self.open(), self.open('lang=it')
        self.assertEqual([p.get_attribute('html', 'lang') for p in (english, italian)], ['en', 'it'])
        self.assertEqual(english.inner_text('nav [aria-current]'), 'Lensing')
        self.assertEqual(italian.inner_text('nav [aria-current]'), 'Lente')
        self.open_groups(italian)
        self.assertIn('doppia precisione', italian.inner_text('#accuracy-words'))
        left = italian.locator('#lensing [lang=en]').all_inner_texts()
        self.assertEqual(left, [], 'what the server says and it.js does not translate')
        labels = [p.locator('#fields .field > label').all_inner_texts() for p in (english, italian)]
        self.assertGreater(len(set(labels[1]) - set(labels[0])), 25)
        italian.click('[data-lang=en]')
        italian.wait_for_selector('html[lang=en]')
        self.shot(self.open('lang=it&over=shadow,flamm&camera.inclination_deg=75', FINE), 'lensing-it')

    def test_overlays_are_the_numbers_of_the_server(self):
        page = self.open('lang=en&spacetime.spin=0.9&camera.inclination_deg=60&camera.field_m=30&over=shadow,photons,isco,ergosphere,orders,flamm')
        page.wait_for_selector('#overlay .over-flamm path', state='attached')
        box = page.evaluate('() => { const b = document.querySelector("#overlay .over-shadow path").getBBox(); return [b.width, b.height]; }')
        shadow = self.physics('shadow', spin=0.9, inclination_deg=60)
        per_m = page.locator('#stage').bounding_box()['width'] / 30
        for got, name in zip(box, ('width', 'height')):
            self.assertAlmostEqual(got / (shadow[name] * per_m), 1, delta=2e-3)
        for name, lines in (('photons', 2), ('isco', 1), ('ergosphere', 1), ('orders', 4)):
            self.assertEqual(page.locator(f'#overlay .over-{name} path').count(), lines, name)
        self.assertIn('r = 2.321 M', page.inner_text('#over-isco-words'))
        self.shot(page, 'overlays')

    def test_the_shadow_line_lies_on_the_shadow(self):
        """With nothing but a sky behind, the picture is black inside the line and not outside."""
        page = self.open('lang=en&disk.model=none&sky.model=grid&sky.grid_deg=1&sky.brightness=1&style.exposure=3&spacetime.spin=0.95'
                         '&camera.field_m=16&camera.inclination_deg=80&camera.roll_deg=25&over=shadow', FINE)
        page.wait_for_selector('#overlay .over-shadow path', state='attached')
        bright = page.evaluate('''async () => {
            const image = document.getElementById('picture'), stage = document.getElementById('stage');
            const canvas = new OffscreenCanvas(stage.clientWidth, stage.clientHeight), context = canvas.getContext('2d');
            context.drawImage(image, 0, 0, canvas.width, canvas.height);
            const data = context.getImageData(0, 0, canvas.width, canvas.height).data;
            const line = document.querySelector('#overlay .over-shadow path'), box = line.getBBox(), count = { inside: 0, outside: 0, lit_inside: 0, lit_outside: 0 };
            const middle = [box.x + box.width / 2, box.y + box.height / 2], point = stage.querySelector('svg').createSVGPoint();
            for (let y = 0; y < canvas.height; y += 3) for (let x = 0; x < canvas.width; x += 3) {
                const at = f => { point.x = middle[0] + (x - middle[0]) * f; point.y = middle[1] + (y - middle[1]) * f; return line.isPointInFill(point); };
                const lit = data[4 * (y * canvas.width + x)] > 8;
                if (at(1.03)) count.inside++, count.lit_inside += lit;
                else if (!at(0.97) && at(0.8)) count.outside++, count.lit_outside += lit;
            }
            return count;
        }''')
        self.assertGreater(min(bright['inside'], bright['outside']), 1000)
        self.assertLess(bright['lit_inside'] / bright['inside'], 0.002, bright)
        self.assertGreater(bright['lit_outside'] / bright['outside'], 0.3, bright)

    def test_lines_of_a_near_camera_lie_on_the_disk(self):
        """Between the direct images of its edges the picture is lit; outside all images of its outer edge it is black."""
        page = self.open('lang=en&spacetime.spin=0.9&camera.r=40&camera.fov_deg=60&camera.inclination_deg=70&camera.yaw_deg=4&camera.roll_deg=15'
                         '&disk.outer=14&disk.taper=0&accuracy.orders=2&style.exposure=9&over=orders,isco', FINE)
        page.wait_for_selector('#overlay .over-orders path', state='attached')
        seen = page.evaluate('''async () => {
            const image = document.getElementById('picture'), stage = document.getElementById('stage'), point = document.getElementById('overlay').createSVGPoint();
            const canvas = new OffscreenCanvas(stage.clientWidth, stage.clientHeight), context = canvas.getContext('2d');
            context.drawImage(image, 0, 0, canvas.width, canvas.height);
            const data = context.getImageData(0, 0, canvas.width, canvas.height).data;
            const [inner, inner_1, outer, outer_1] = document.querySelectorAll('.over-orders path'), count = { on: 0, off: 0, lit_on: 0, lit_off: 0 };
            for (const line of [inner, inner_1, outer, outer_1]) line.style.strokeWidth = 6;
            for (let y = 0; y < canvas.height; y += 2) for (let x = 0; x < canvas.width; x += 2) {
                point.x = x + 0.5, point.y = y + 0.5;
                if ([inner, inner_1, outer, outer_1].some(line => line.isPointInStroke(point))) continue;
                const lit = data[4 * (y * canvas.width + x)] > 8, inside = line => line.isPointInFill(point);
                if (inside(outer) && !inside(inner)) count.on++, count.lit_on += lit;
                else if (!inside(outer) && !inside(outer_1)) count.off++, count.lit_off += lit;
            }
            return count;
        }''')
        self.assertGreater(min(seen['on'], seen['off']), 3000, seen)
        self.assertGreater(seen['lit_on'] / seen['on'], 0.998, seen)
        self.assertLess(seen['lit_off'] / seen['off'], 0.002, seen)
        self.shot(page, 'overlays-near')
        self.expected = '422'
        self.open_groups(page)
        page.fill('[data-path="disk.outer"] input[type=number]', '60')
        page.keyboard.press('Enter')
        page.wait_for_selector('#over-orders-words:has-text("drawn for cameras well outside it")')
        self.assertEqual(page.locator('#overlay .over-isco path').count(), 1)

    def test_orbits(self):
        page = self.open('lang=en&view=orbits', '#orbit-picture .front')
        self.assertEqual(page.locator('#orbits math').count(), 2)
        page.wait_for_selector('#orbit-plots canvas >> nth=1', state='attached')
        for plot in range(2):
            self.assertGreater(self.drawn(page, f'#orbit-plots canvas >> nth={plot}')['coloured'], 300, plot)
        self.assertIn('Advance of the periastron', page.inner_text('#orbit-facts'))
        self.assertNotEqual(page.inner_text('#orbit-live'), '')
        self.shot(page, 'orbits', full_page=True)
        before = page.get_attribute('#orbit-picture .front', 'd')
        page.focus('#orbit-turn')
        page.keyboard.press('ArrowRight')
        self.assertNotEqual(page.get_attribute('#orbit-picture .front', 'd'), before)
        page.select_option('#in-orbit-orbit', 'mercury')
        page.wait_for_selector('#orbit-facts >> text=/10⁻⁵°/')
        self.assertEqual(page.inner_text('#orbit-fault'), '')
        self.assertIn('42.98″', page.inner_text('#orbit-facts'))

    def facts(self, page):
        return dict(row.split('\t') for row in page.locator('#orbit-facts tr').all_inner_texts())

    def test_orbits_that_end_and_that_there_are_not(self):
        page = self.open('lang=en&view=orbits&orbit.orbit=plunge', '#orbit-picture .front')
        self.assertEqual((page.inner_text('#orbit-fault'), self.facts(page)['Fate']), ('', 'plunge'))
        self.assertTrue(self.facts(page)['Nearest, farthest'].startswith('horizon'))
        page.select_option('#in-orbit-orbit', 'isco')
        page.wait_for_selector('#orbit-facts >> text=bound')
        facts = self.facts(page)
        self.assertEqual({facts['Advance of the periastron, exact'], facts['Advance of the node (dragging)']}, {'–'})
        page.select_option('#in-orbit-orbit', 'zoom-whirl')
        page.wait_for_selector('#orbit-facts >> text=/0.8,/')
        whirls = float(self.facts(page)['Advance of the periastron, exact'].rstrip('°').replace(',', '')) / 360 + 1
        self.assertGreater(page.get_attribute('#orbit-picture .front', 'd').count('C'), 12 * whirls * 10, 'half of it is in front')
        self.expected = '422'
        page.select_option('#in-orbit-orbit', 'shape')
        page.fill('#in-orbit-p', '2')
        page.keyboard.press('Tab')
        page.wait_for_selector('#orbit-fault >> text=separatrix')
        self.assertEqual((page.inner_text('#orbit-facts'), page.locator('#orbit-picture .front').count()), ('', 0))
        self.assertFalse(page.is_visible('#orbit-plots'))

    def test_physics(self):
        page = self.open('lang=en&view=physics', '#curves .card:last-child canvas')
        cards = page.locator('.card')
        self.assertGreaterEqual(cards.count(), 9)
        for i in range(cards.count()):
            name = cards.nth(i).get_attribute('id')
            self.assertGreater(self.drawn(page, f'#{name} canvas')['coloured'], 300, name)
            page.click(f'#{name} summary >> nth=0')
            page.wait_for_selector(f'#{name} tbody tr', timeout=2000)
            self.assertGreater(page.locator(f'#{name} tbody tr').count(), 10, name)
            self.assertEqual(cards.nth(i).locator('.fault').inner_text(), '')
            self.assertEqual(cards.nth(i).locator('math').count(), 1)
        self.shot(page, 'physics', full_page=True)
        last = page.locator('#curve-kerr tbody tr').first.inner_text().split()
        self.assertEqual(last, ['0', '3', '3', '6', '6', '2'])
        before = self.drawn(page, '#curve-qnm canvas')
        page.fill('#in-qnm-spin', '0.95')
        page.keyboard.press('Tab')
        page.wait_for_timeout(800)
        self.assertNotEqual(self.drawn(page, '#curve-qnm canvas')['hash'], before['hash'])
        self.assertIn('qnm.spin=0.95', page.url)

    def test_a_ringdown_is_heard(self):
        page = self.open('lang=en&view=physics&qnm.mass_msun=4e6', '#curve-qnm a[href*=wav]')
        self.assertIn('16 octaves higher', page.inner_text('#curve-qnm'))
        with page.expect_response('**/v1/physics/qnm*format=wav') as answer:
            page.click('#curve-qnm button:has-text("Hear it")')
        self.assertEqual((answer.value.status, answer.value.headers['content-type']), (206 if 'content-range' in answer.value.headers else 200, 'audio/wav'))
        with page.expect_download() as download:
            page.click('#curve-qnm a[href*=wav]')
        self.assertEqual(pathlib.Path(download.value.path()).read_bytes()[:4], b'RIFF')

    def test_a_ringdown_is_shifted_by_hand(self):
        page = self.open('lang=en&view=physics&qnm.octaves=-3', '#curve-qnm a[href*=wav]')
        self.assertIn('3 octaves lower', page.inner_text('#curve-qnm'))
        self.assertIn('shift_octaves=-3', page.get_attribute('#curve-qnm a[href*=wav]', 'href'))
        page.fill('#in-qnm-octaves', '-6')
        page.keyboard.press('Tab')
        page.wait_for_selector('#curve-qnm >> text=/No ear hears 4.48 Hz/')
        self.assertEqual(page.locator('#curve-qnm a[href*=wav]').count(), 0)

    def test_refusals_are_told_in_italian(self):
        page = self.open('lang=it')
        wrong = ('disk.inner=1', 'camera.r=1.5', 'spacetime.spin=2', 'spacetime.spin=abc', 'disk.outer=3', 'disk.model=foo', 'camera.projection=pinhole',
                 'camera.projection=ring&camera.r=50', 'camera.r=40&camera.projection=plane', 'spot1.brightness=1&spot1.r=2', 'disk.particles=1e10',
                 'style.ringdown=1&spacetime.spin=0.99995', 'camera.observer=static&camera.r=1.8&spacetime.spin=0.9', 'accuracy.steps=7',
                 'disk.mdot_edd=1e9&disk.colour=accretion', 'camera.inclination_deg=200', 'spacetime.mass_msun=0')
        answers = []
        for query in [f'render?{q}' for q in wrong] + ['physics/qnm?l=2&m=3', 'physics/redshift?r=1.2&spin=0.5', 'physics/ring-image?r=1&spin=0.5', 'physics/kerr?spin=2']:
            answers.append(self.daemon.request('GET', '/v1/' + query))
        for spin, p, e in ((2, 6, 0), (0.9, 6, 1), (0.9, 2, 0.5)):
            answers.append(self.daemon.request('POST', '/v1/orbits', json.dumps({'spin': spin, 'orbit': {'p': p, 'e': e}})))
        for answer in answers:
            self.assertEqual(answer.status, 422)
            detail = answer.json()['detail']
            told = page.evaluate('async detail => (await import("./web/it.js")).refusal(detail)', detail)
            self.assertNotRegex(told or 'allowed', r'allowed|\{|undefined| is | of |degrees|masses', detail)
        self.assertEqual(page.evaluate('async () => (await import("./web/it.js")).refusal("what is this, allowed are none")'), None)

    def test_plots_are_read_by_keyboard(self):
        page = self.open('lang=en&view=physics', '#curves .card:last-child canvas')
        chart = page.locator('#curve-kerr .chart')
        chart.focus()
        page.keyboard.press('Home')
        self.assertEqual(page.locator('#curve-kerr .legend b').all_inner_texts(), ['3', '3', '6', '6', '2'])
        self.assertTrue(chart.get_attribute('aria-valuetext').startswith('spin a / M: 0; photon, with the spin: 3;'))
        page.keyboard.press('ArrowRight')
        page.keyboard.press('PageUp')
        self.assertAlmostEqual(float(chart.get_attribute('aria-valuenow')), 11 * 0.999 / 111, places=12)
        before = self.drawn(page, '#curve-kerr canvas')
        button = page.locator('#curve-kerr .legend button').first
        button.focus()
        page.keyboard.press('Space')
        self.assertEqual(button.get_attribute('aria-pressed'), 'false')
        self.assertLess(self.drawn(page, '#curve-kerr canvas')['coloured'], before['coloured'] - 200)

    def test_real_scale(self):
        page = self.open('lang=en&view=scale', '#scale-rows tr')
        self.assertIn('42 µas', page.inner_text('#scale-rows'))
        self.assertEqual(page.locator('#scale math').count(), 3)
        self.shot(page, 'scale')
        page.select_option('#in-scale-hole', 'sgra')
        page.wait_for_selector('#scale-rows >> text=51.8 µas')
        page.select_option('#in-scale-hole', 'none')
        page.fill('#in-scale-mass_msun', '1e9')
        page.keyboard.press('Tab')
        page.wait_for_timeout(500)
        self.assertNotIn('measured', page.inner_text('#scale-rows'))

    def test_phone(self):
        phone = {'viewport': {'width': 390, 'height': 844}, 'device_scale_factor': 2, 'has_touch': True, 'is_mobile': True}
        for view in VIEWS:
            with self.subTest(view):
                page = self.open(f'lang=it&view={view}', {'lensing': AT_REST, 'orbits': '#orbit-picture .front', 'scale': '#scale-rows tr',
                                                         'physics': '#curves .card:last-child canvas'}[view], **phone)
                self.open_groups(page)
                self.assertLessEqual(page.evaluate('() => document.documentElement.scrollWidth'), 390)
                small = page.evaluate('''() => [...document.querySelectorAll('button, a.button, select, summary, input:not([type=range]):not([type=checkbox])')]
                    .filter(n => n.offsetParent && Math.min(n.offsetWidth, n.offsetHeight) < 24).map(n => n.outerHTML.slice(0, 80))''')
                self.assertEqual(small, [])
                self.shot(page, 'phone-' + view)

    def test_narrow(self):
        for view, ready in (('lensing', AT_REST), ('physics', '#curves .card:last-child canvas'), ('orbits', '#orbit-picture .front')):
            page = self.open(f'lang=it&view={view}', ready, viewport={'width': 320, 'height': 640})
            self.assertLessEqual(page.evaluate('() => document.documentElement.scrollWidth'), 320, view)

    def test_low(self):
        page = self.open(viewport={'width': 1100, 'height': 420})
        self.open_groups(page)
        self.assertEqual(page.evaluate('() => document.documentElement.scrollHeight'), 420, 'the panel scrolls, the page does not')
        page = self.open(viewport={'width': 500, 'height': 320}, device_scale_factor=2)  # a small window, and twice the size
        box = page.locator('#stage').bounding_box()
        self.assertLess(box['y'] + box['height'], 300)
        page = self.open('lang=it', viewport={'width': 844, 'height': 390}, has_touch=True)
        self.assertLess(page.locator('header').bounding_box()['height'], 60)
        box = page.locator('#stage').bounding_box()
        self.assertLess(box['y'] + box['height'], 320, 'there is room beside the picture to scroll by')

    def test_back_goes_from_view_to_view(self):
        page = self.open()
        for view in ('physics', 'scale'):
            page.click(f'nav [data-view={view}]')
        loaded = len([r for r in self.requests if r.url.endswith('/app.js')])
        self.assertIn('view=scale', page.url)
        page.go_back()
        page.wait_for_selector('body[data-view=physics]')
        page.fill('#in-qnm-spin', '0.9')
        page.keyboard.press('Tab')
        page.go_back()
        page.wait_for_selector('body[data-view=lensing]')
        page.wait_for_timeout(300)
        self.assertNotIn('view=', page.url)
        self.assertIn('qnm.spin=0.9', page.url, 'what was changed stays')
        page.go_forward()
        page.wait_for_selector('body[data-view=physics]')
        self.assertEqual(page.input_value('#in-qnm-spin'), '0.9')
        self.assertEqual(len([r for r in self.requests if r.url.endswith('/app.js')]), loaded, 'without a new load')
        page.evaluate('() => { location.hash = "lang=it&spacetime.spin=0.5"; }')  # as if typed
        page.wait_for_selector('html[lang=it] ' + AT_REST)
        self.assertEqual(self.field(page, 'spacetime.spin'), '0.5')
        page.go_back()
        page.wait_for_selector('html[lang=en] body[data-view=physics]')

    def test_a_server_that_is_full_or_gone(self):
        full = dict(status=503, content_type='application/problem+json', body='{"status":503,"detail":"16 sessions are open, as many as may"}')
        for lang, answer, told in (('it', lambda r: r.fulfill(**full), 'sono aperte 16 sessioni, quante se ne possono aprire – si riprova'),
                                   ('en', lambda r: r.abort(), 'The server does not answer – trying again')):
            context = self.browser.new_context(viewport={'width': 1000, 'height': 640})
            self.contexts.append(context)
            page = context.new_page()
            page.route('**/v1/sessions', answer)
            page.goto(self.base + '#lang=' + lang)
            page.wait_for_selector('#status[data-wrong]')
            self.assertEqual(page.inner_text('#status'), told)
            page.unroute('**/v1/sessions')
            page.wait_for_selector(AT_REST)
            self.assertIsNone(page.get_attribute('#status', 'data-wrong'))

    def test_a_session_that_has_ended_is_opened_anew(self):
        page = self.open()
        self.expected = '404'
        gone = []

        def answer(route):
            if gone:
                return route.continue_()
            gone.append(route.request.url)
            route.fulfill(status=404, content_type='application/problem+json', body='{"status":404,"detail":"the session has ended"}')

        page.route('**/frame.png*', answer)
        page.focus('#stage')
        page.keyboard.press('Shift+ArrowUp')
        opened = lambda: page.evaluate('0') or [r for r in self.requests if r.url.endswith('/v1/sessions')]
        self.assertTrue(daemon.eventually(lambda: len(opened()) == 2))
        page.wait_for_selector(AT_REST)
        before = self.pixels(page)
        page.keyboard.press('Shift+ArrowUp')
        self.assertTrue(daemon.eventually(lambda: self.pixels(page) != before))
        self.assertEqual((len(gone), len(opened())), (1, 2))

    def test_a_scene_that_goes_on(self):
        page = self.open('lang=en&sky.model=grid&motion.azimuth_rate_deg=30', '#stage[data-final]') # it may never be at rest
        seen = set()
        self.assertTrue(daemon.eventually(lambda: seen.add(self.pixels(page)) or len(seen) > 5, 20))
        self.assertIn('pictures a second', page.inner_text('#status'))

    def clock(self, page):
        return float(page.inner_text('#clock').split()[2].replace(',', ''))

    def test_time_goes_on_and_stands(self):
        page = self.open('lang=en&preset=living-disk', '#stage[data-final]')
        self.assertTrue(daemon.eventually(lambda: page.inner_text('#clock') and self.clock(page) > 1, 20))
        seen = set()
        self.assertTrue(daemon.eventually(lambda: seen.add(self.pixels(page)) or len(seen) > 3, 20))
        self.assertRegex(page.inner_text('#clock'), r'^t = [\d.,]+ M = [\d.]+ (minutes|hours)$')
        self.assertEqual(page.get_attribute('#status', 'aria-live'), 'off', 'thirty captions a second are not for reading aloud')
        page.click('#play')
        page.wait_for_selector(FINE)
        self.assertEqual(page.get_attribute('#status', 'aria-live'), 'polite')
        stood, picture, before = self.clock(page), self.pixels(page), len(self.requests)
        page.wait_for_timeout(1000)
        self.assertEqual((self.clock(page), self.pixels(page), len(self.requests), page.inner_text('#play')), (stood, picture, before, 'Play'))
        self.assertIn('pause=1', page.url)
        self.assertAlmostEqual(float(self.field(page, 'time')), stood, delta=0.06)
        self.assertEqual(page.input_value('#preset'), 'living-disk')
        self.assertAlmostEqual(json.loads(page.input_value('#scene-text'))['time'], stood, delta=0.06)
        self.assertRegex(page.get_attribute('#save', 'href'), f'time={int(stood)}')
        page.focus('#stage')
        page.keyboard.press('Space')
        self.assertTrue(daemon.eventually(lambda: self.clock(page) > stood))
        self.assertLess(self.clock(page), stood + 40, 'it went on from where it stood')
        page.fill('[data-path="time"] input[type=number]', '0')
        page.keyboard.press('Enter')
        self.assertTrue(daemon.eventually(lambda: self.clock(page) < stood))
        page.fill('[data-path="motion.time_rate"] input[type=number]', '-50')
        page.keyboard.press('Enter')
        self.assertTrue(daemon.eventually(lambda: page.inner_text('#clock').startswith('t = −')))
        self.shot(page, 'living-disk')

    def test_what_is_not_seen_is_not_asked_for(self):
        page = self.open('lang=en&preset=living-disk', '#stage[data-final]')
        pictures = lambda: page.evaluate('0') or len([r for r in self.requests if '/frame.png' in r.url])
        hide = '''hidden => {
            Object.defineProperty(document, 'hidden', { configurable: true, get: () => hidden });
            document.dispatchEvent(new Event('visibilitychange'));
        }'''
        for away, back in ((lambda: page.click('nav [data-view=physics]'), lambda: page.go_back()),
                           (lambda: page.evaluate(hide, True), lambda: page.evaluate(hide, False))):
            away()
            page.wait_for_timeout(300)
            before = pictures()
            page.wait_for_timeout(1000)
            self.assertEqual(pictures(), before)
            back()
            self.assertTrue(daemon.eventually(lambda: pictures() > before + 5))

    def test_a_page_that_is_closed_ends_its_session(self):
        page = self.open()
        own = next(r.response().json() for r in self.requests if r.url.endswith('/v1/sessions'))
        self.assertEqual(self.daemon.get('/v1/sessions/' + own['id']).status, 200)
        page.close()
        self.assertTrue(daemon.eventually(lambda: self.daemon.get('/v1/sessions/' + own['id']).status == 404, 5))

    def test_other_particles_and_a_spot(self):
        page = self.open('lang=en&camera.inclination_deg=60')
        self.assertFalse(page.is_visible('#play'))
        page.click('#as-particles')
        page.wait_for_selector('#play:has-text("Pause")')
        page.click('#play')
        page.wait_for_selector(FINE)
        before = self.pixels(page)
        page.click('#new-seed')
        page.wait_for_selector(FINE)
        other = self.pixels(page)
        self.assertNotEqual(other, before)
        page.click('#spot')
        page.wait_for_selector(FINE)
        self.assertNotEqual(self.pixels(page), other)
        self.open_groups(page)
        self.assertTrue(page.is_visible('[data-path="spot1.r"]'))
        self.assertFalse(page.is_visible('[data-path="spot2.r"]'))
        self.assertIn('spots: ', page.inner_text('#approximations'))
        page.click('#spot')
        page.wait_for_selector(FINE)
        self.assertEqual(self.pixels(page), other)
        page.click('#as-particles')
        page.wait_for_selector(FINE)
        self.assertEqual((page.get_attribute('#as-particles', 'aria-pressed'), page.is_visible('#new-seed')), ('false', False))

    def test_the_light_of_a_spot(self):
        page = self.open('lang=en&preset=hot-spot', '#light canvas')
        page.fill('[data-path="motion.time_rate"] input[type=number]', '60')
        page.keyboard.press('Enter')
        start = self.clock(page)
        self.assertTrue(daemon.eventually(lambda: self.clock(page) > start + 200, 30))
        self.assertGreater(self.drawn(page, '#light canvas')['coloured'], 100)
        page.click('#light summary >> nth=0')
        page.wait_for_selector('#light tbody tr >> nth=5')
        rows = [[value(cell) for cell in row.split('\t')] for row in page.locator('#light tbody tr').all_inner_texts()]
        times, everything, spots = zip(*rows)
        self.assertEqual(sorted(times), list(times))
        self.assertGreater(max(spots), 1.5 * min(spots))
        self.assertTrue(all(a > s > 0 for a, s in zip(everything, spots)))
        self.assertGreater(len(page.get_attribute('#light .track', 'd')), 100)
        page.click('#strike')
        self.assertTrue(daemon.eventually(lambda: 'style.ringdown=1' in page.evaluate('location.hash')))
        struck = self.clock(page)
        self.assertTrue(daemon.eventually(lambda: self.clock(page) > struck + 60, 20))
        for _ in range(2):
            page.click('#light summary >> nth=0')
        page.wait_for_selector('#light tbody tr >> nth=5')
        self.assertEqual(value(page.locator('#light tbody th').first.inner_text()), times[0], 'the curve goes on over a strike')
        with page.expect_download() as download:
            page.click('#light a >> nth=0')
        lines = pathlib.Path(download.value.path()).read_text().splitlines()
        self.assertEqual((lines[0], len(lines) > 60), ('"time t / M","all","spots"', True))
        latest = max(float(line.split(',')[0]) for line in lines[1:])
        self.assertTrue(daemon.eventually(lambda:
                                          max(value(x) for x in page.locator('#light figure:first-child tbody th').all_inner_texts()) > latest))
        page.click('#play')
        self.shot(page, 'hot-spot')
        page.click('#spot')
        page.wait_for_selector('#light', state='hidden')
        page.wait_for_selector(FINE)
        before = len(self.requests)
        page.wait_for_timeout(800)
        self.assertEqual(len(self.requests), before)

    def test_a_struck_hole_rings(self):
        page = self.open('lang=en&camera.inclination_deg=30', FINE)
        before = self.pixels(page)
        page.click('#strike')
        seen = set()
        self.assertTrue(daemon.eventually(lambda: seen.add(self.pixels(page)) or len(seen - {before}) > 2, 20))
        self.assertEqual([r.method for r in self.requests if r.url.endswith('/ringdown')], ['POST'])
        self.assertIn('ringdown: an illustration', page.inner_text('#approximations'))
        self.assertTrue(daemon.eventually(lambda: 'style.ringdown=1' in page.evaluate('location.hash')))
        page.click('#hear')
        page.wait_for_selector('#curve-qnm >> text=/octaves higher/')
        self.assertTrue(daemon.eventually(lambda: page.locator('#curve-qnm').bounding_box()['y'] < 300))
        self.assertEqual((page.input_value('#in-qnm-spin'), page.input_value('#in-qnm-mass_msun')), ('0.7', '100000000'))
        page.click('[data-view=lensing]')
        self.open_groups(page)
        page.fill('[data-path="accuracy.orders"] input[type=number]', '1')
        page.keyboard.press('Enter')
        self.assertFalse(page.is_visible('#strike'), 'without orders from 1 up there is nothing to ring')

    def test_no_light_curve_of_a_ring(self):
        page = self.open('lang=en&preset=photon-rings', '#stage[data-final]')
        page.click('#spot')
        page.wait_for_selector('#light >> text=no light curve')
        self.assertFalse(page.is_visible('#light figure'))

    def test_what_a_link_or_a_hand_gets_wrong(self):
        page = self.open('lang=en&foo=1&camera.roll=2&spacetime.spin=x&orbit.p=7')
        self.assertEqual(page.inner_text('#link-fault'), 'Of the link this was not understood: spacetime.spin, foo, camera.roll.')
        self.open_groups(page)
        page.fill('[data-path="spacetime.spin"] input[type=number]', '2')
        page.keyboard.press('Enter')
        page.wait_for_timeout(300)
        self.assertEqual((self.field(page, 'spacetime.spin'), page.locator('[data-path="spacetime.spin"] input:invalid').count()), ('2', 1))

        page = self.open('lang=en&camera.r=&time=1e400&disk.slow_light=yes&spacetime.spin=0.5')
        self.assertEqual(page.inner_text('#link-fault'), 'Of the link this was not understood: camera.r, disk.slow_light, time.')
        self.assertEqual(self.field(page, 'spacetime.spin'), '0.5')

    def test_a_link_to_no_preset(self):
        self.expected = '404'
        page = self.open('lang=en&preset=nosuch')
        self.assertEqual(page.inner_text('#link-fault'), 'Of the link this was not understood: preset.')
        self.assertEqual(page.input_value('#preset'), '')
        self.assertFalse(page.get_attribute('#status', 'data-wrong'))

    def test_when_the_rings_have_faded(self):
        page = self.open('lang=en&motion.time_rate=60')
        page.click('#strike')
        self.assertTrue(daemon.eventually(lambda: 'at rest' in page.inner_text('#clock'), 30))
        before, asked = self.clock(page), len(self.requests)
        self.assertTrue(daemon.eventually(lambda: self.clock(page) > before + 90))
        self.assertEqual([r.url for r in self.requests[asked:] if '/v1/' in r.url], [])
        link = dict(pair.split('=') for pair in page.url.split('#')[1].split('&'))
        self.assertGreater(float(link['time']), float(link['style.ringdown_time']) + 60, 'a link from here does not strike again')

    def test_a_strike_that_is_refused(self):
        page = self.open('lang=en&spacetime.spin=0.99995')
        self.expected = '422'
        page.click('#strike')
        page.wait_for_selector('#strike-fault >> text=beyond 0.9999')
        page.wait_for_timeout(600)
        self.assertIn('beyond 0.9999', page.inner_text('#strike-fault'), 'no picture takes it away')

    def test_a_refused_link_says_why(self):
        self.expected = '422'
        page = self.open('lang=en&disk.inner=1', '#status[data-wrong]')
        self.assertIn('disk.inner', page.inner_text('#status'))

    def test_reduced_motion_holds_time(self):
        for fragment, motion in (('pause=1', 'no-preference'), ('', 'reduce')):
            page = self.open('lang=en&preset=living-disk&' + fragment, FINE, reduced_motion=motion)
            self.assertEqual((self.clock(page), page.inner_text('#play')), (0, 'Play'))
        page.click('#play')
        self.assertTrue(daemon.eventually(lambda: self.clock(page) > 1))

    def test_the_box_of_presets_follows(self):
        page = self.open('lang=en&preset=gargantua')
        page.wait_for_selector('#preset option:nth-child(3)', state='attached')
        self.assertEqual((page.input_value('#preset'), self.field(page, 'camera.r')), ('gargantua', '74.1'))
        again = self.open(page.url.split('#')[1])
        self.assertTrue(daemon.eventually(lambda: again.input_value('#preset') == 'gargantua'))
        self.drag(again, 20, 20)
        self.assertEqual((again.input_value('#preset'), again.inner_text('#preset-help')), ('own', ''))
        again.wait_for_timeout(300)
        self.assertNotIn('preset=', again.url)
        again.click('#reset')
        self.assertEqual(again.input_value('#preset'), '')

    def test_reduced_motion(self):
        page = self.open('lang=en&view=orbits', '#orbit-picture .body[cx]', reduced_motion='reduce')
        self.assertEqual(page.inner_text('#orbit-play'), 'Play')
        before = page.get_attribute('#orbit-picture .body', 'cx')
        page.wait_for_timeout(600)
        self.assertEqual(page.get_attribute('#orbit-picture .body', 'cx'), before)

    def test_axe(self):
        try:
            from axe_playwright_python.sync_playwright import Axe
        except ImportError:
            self.skipTest('axe-playwright-python is not installed')
        ready = {'lensing': AT_REST, 'orbits': '#orbit-picture .front', 'physics': '#curves .card:last-child canvas', 'scale': '#scale-rows tr'}
        scenes = [(view, f'view={view}&over=shadow', ready[view]) for view in VIEWS] + [('spot', 'preset=hot-spot&pause=1', '#light .track')]
        for view, fragment, there in scenes:
            for lang in ('en', 'it'):
                with self.subTest(view=view, lang=lang):
                    page = self.open(f'lang={lang}&{fragment}', there)
                    self.open_groups(page)
                    results = Axe().run(page, options={'runOnly': ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice']})
                    self.assertGreater(len(results.response['passes']), 15)
                    found = [f'{v["id"]}: {v["help"]}: {[n["html"][:120] for n in v["nodes"]][:3]}' for v in results.response['violations']]
                    self.assertEqual(found, [])


if __name__ == '__main__':
    try:
        from playwright.sync_api import sync_playwright
    except ImportError:
        print('skipped: Playwright for Python is not installed')
        sys.exit(77)
    if not CHROMIUM:
        print('skipped: there is no chromium')
        sys.exit(77)
    KERRD, SHOTS = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv.pop(2)) / 'screenshots'
    if 'devices: none' in subprocess.run([KERRD, 'doctor'], capture_output=True, text=True, timeout=60).stdout:
        print('skipped: no Vulkan device')
        sys.exit(77)
    sys.argv.insert(2, 'serve')
    daemon.main()
