// In the first view the camera drifts round the hole until the user touches anything. It does not drift if the user
// prefers reduced motion. If the server renders too few pictures per second, a recording of the drift plays instead
// (loop.js). At the first touch, live pictures continue from the camera of the recording.
import { atFirstTouch, still } from '../base/dom.js';
import { begun, end, leave, length_s, play, rate_deg, seconds } from './loop.js';
import { goesOn } from '../share/share.js';

const trial_ms = 3000; // duration of the trial in which live pictures are counted
const least_pace = 4; // minimum pictures per second; below it, the recording plays
const tell_ms = 250; // time between two updates of the scene while the recording plays

// fresh: true if the user has not touched anything yet. Returns shown(frame); the caller calls it with each picture.
export function begin(stage, scene, fresh) {
  const drifts =
    fresh &&
    !scene.held &&
    !still.matches &&
    scene.get('motion.azimuth_rate_deg') === 0 &&
    scene.get('motion.proper_time_rate') === 0;
  let pictures = 0,
    timer = 0,
    // value of scene.jumps when live pictures continued after the recording; -1 if the recording never played
    jumps = -1;
  if (!drifts) {
    end();
    return () => begun() && leave();
  }

  const tell = () =>
    scene.tick(seconds() * scene.get('motion.time_rate'), false, {
      'camera.azimuth_deg': Number((seconds() * rate_deg).toFixed(3)), // rounded like the azimuth of live pictures
    });

  // Returns a promise of whether the recording plays.
  async function record() {
    if (!(await play(stage, () => scene.get('camera.azimuth_deg') / rate_deg)) || !scene.drift) return false;
    clearTimeout(timer);
    scene.record();
    tell();
    timer = setInterval(tell, tell_ms);
    return true;
  }

  const sees = () => !document.hidden && document.body.dataset.view === 'lensing';
  let seen; // true if the stage was visible during the whole trial
  const look = () => (seen &&= sees());
  for (const event of ['visibilitychange', 'viewchange']) document.addEventListener(event, look);
  function judge() {
    // the recording would end before it reaches this azimuth
    if (scene.get('camera.azimuth_deg') > rate_deg * (length_s - 1)) return;
    if (seen && pictures < (least_pace * trial_ms) / 1000) return void record();
    trial();
  }
  function trial() {
    pictures = 0;
    seen = sees();
    timer = setTimeout(judge, trial_ms);
  }

  function stop() {
    if (scene.drift) return;
    scene.removeEventListener('drift', stop);
    for (const event of ['visibilitychange', 'viewchange']) document.removeEventListener(event, look);
    cancel();
    still.removeEventListener('change', touch);
    clearTimeout(timer);
    stand();
  }
  function stand() {
    end();
    jumps = scene.jumps;
  }
  function touch() {
    if (scene.recorded) end(), tell();
    scene.drifts(0);
  }
  const cancel = atFirstTouch(touch);
  still.addEventListener('change', touch);
  scene.addEventListener('drift', stop);
  scene.drifts(rate_deg);
  if (goesOn('lesson'))
    stand(); // live pictures are used instead of the recording, because the class follows the session
  else if (begun()) record().then(plays => plays || (scene.drift && trial()));
  else trial();
  return frame => {
    pictures++;
    if (jumps >= 0 && frame.shows && frame.jumps >= jumps) leave();
  };
}
