"""The view of orbits: orbits.py KERRD FOLDER (browser.py)."""
from browser import Browser, main
import daemon


class Orbits(Browser):
    def facts(self, page):
        return dict(row.split('\t') for row in page.locator('#orbit-facts tr').all_inner_texts())

    def test_orbits(self):
        page = self.open('lang=en&view=orbits', '#orbit-picture .front')
        self.assertEqual(page.locator('#orbits math').count(), 2)
        page.wait_for_selector('#orbit-plots canvas >> nth=1', state='attached')
        for plot in range(2):
            self.assertTrue(daemon.eventually(lambda: self.drawn(page, f'#orbit-plots canvas >> nth={plot}')['coloured'] > 300), plot)
        self.there(page, 'Advance of the periastron', '#orbit-facts')
        self.assertTrue(daemon.eventually(lambda: page.inner_text('#orbit-live')))
        self.shot(page, 'orbits', full_page=True)
        before = page.get_attribute('#orbit-picture .front', 'd')
        page.focus('#orbit-turn')
        page.keyboard.press('ArrowRight')
        self.assertNotEqual(page.get_attribute('#orbit-picture .front', 'd'), before)
        page.select_option('#in-orbit-orbit', 'mercury')
        page.wait_for_selector('#orbit-facts >> text=/10⁻⁵°/')
        self.assertEqual(page.inner_text('#orbit-fault'), '')
        self.assertIn('42.98″', page.inner_text('#orbit-facts'))

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
        kept = page.inner_text('#orbit-kept')
        self.assertRegex(kept, r'^Still shown is the last one that there was: a = 0.9 M, p = 6.5 M, e = 0.5, inclination 30°')
        self.assertEqual((self.facts(page)['Fate'], page.locator('#orbit-picture .front').count()), ('bound', 1))
        self.assertTrue(page.is_visible('#orbit-plots'))
        self.shot(page, 'orbits-kept')
        page.fill('#in-orbit-p', '8')
        page.keyboard.press('Tab')
        page.wait_for_function('() => !document.getElementById("orbit-kept").textContent')
        self.assertEqual((page.inner_text('#orbit-fault'), page.title()), ('', 'Orbits: a = 0.9 M, p = 8 M, e = 0.5, inclination 30° – kerrd'))
        self.assertIn('p = 8 M', page.get_attribute('#orbit-picture svg', 'aria-label'))

    def test_p_goes_by_factors(self):
        page = self.open('lang=en&view=orbits', '#orbit-picture .front')
        page.evaluate("""() => {
            const slider = document.getElementById('in-orbit-p').closest('.field').querySelector('input[type=range]');
            slider.value = 500;
            slider.dispatchEvent(new Event('input'));
        }""")
        self.assertAlmostEqual(float(page.input_value('#in-orbit-p')), 200 ** 0.5, delta=0.1)

    def test_reduced_motion(self):
        page = self.open('lang=en&view=orbits', '#orbit-picture .body[cx]', reduced_motion='reduce')
        self.assertEqual(page.inner_text('#orbit-play'), 'Play')
        before = page.get_attribute('#orbit-picture .body', 'cx')
        page.wait_for_timeout(600)
        self.assertEqual(page.get_attribute('#orbit-picture .body', 'cx'), before)


if __name__ == '__main__':
    main()
