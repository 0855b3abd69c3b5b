// What the page does with each picture that arrives, with a picture at rest, and with a refusal.
import { brief, caption, showAccuracy } from './accuracy.js';
import { buildCarry } from './carry.js';
import { buildRefining } from './refining.js';
import { say, sayRecorded, sayRefining, saysWrong, sayWrong } from '../words/status.js';
import { describe } from '../words/describe.js';

// minimum time between two updates of the words and numbers beside a moving picture
const telling_ms = 250;

// parts: promise of { complain, drawOverlays }, which exist after the first picture. address(): address of the session.
// needed, asked: the parts of the page that are loaded later (controls/later.js).
export function buildShown(stage, scene, parts, address, needed, asked) {
  const carry = buildCarry(stage, scene),
    followFiner = buildRefining(address, sayRefining);
  let told_ms = -Infinity,
    any = false, // true as soon as one picture has been shown
    drift = () => {}, // function that is called with each picture
    resting = false,
    seen;
  const first = new Promise(resolve => (seen = resolve));

  function sayShown(frame) {
    const rests = frame.final && !scene.goesOn();
    scene.recorded ? sayRecorded() : say(brief(frame, scene.goesOn()), rests, caption(frame));
    showAccuracy(frame, scene);
  }

  function mark() {
    if (!performance.getEntriesByName('first-picture').length) performance.mark('first-picture');
    setTimeout(seen);
  }

  async function show(frame) {
    const now = performance.now(),
      // true if the words beside the picture are updated
      tells = frame.final || now - told_ms > telling_ms;
    if (tells) told_ms = now;
    await carry(frame.picture, frame, tells ? describe(scene) : null);
    if (!any) requestAnimationFrame(mark);
    any = true;
    const { complain } = await parts;
    drift(frame);
    asked.shown(frame);
    needed.shown(frame);
    stage.dataset.samples = frame.samples;
    followFiner(!frame.final && !scene.goesOn());
    complain('', '');
    if (tells || saysWrong()) sayShown(frame);
  }

  async function rests(whether) {
    resting = whether;
    if (whether && stage.dataset.final !== 'true') (await parts).drawOverlays();
    stage.dataset.final = resting; // the scene may have changed while the picture was on its way
    if (resting) followFiner(false), needed.rests();
    else if (!scene.goesOn()) followFiner(true);
  }

  async function refuse(error) {
    seen();
    followFiner(false);
    const { complain } = await parts;
    asked.halt();
    complain(error.pointer, error.message);
    sayWrong(error);
  }

  // first: promise that is resolved when the first picture is on the screen, or is refused
  return { show, rests, refuse, first, followFiner, follow: each => (drift = each) };
}
