// Downloads of a playground: numbers, a snapshot and films; and the upload of a snapshot.
import { remembered } from '../../base/job.js';
import { take } from '../../base/server.js';

// part: see playground-parts.js. running: see running.js. act(task) runs a task and shows its error. begin(snapshot)
// starts a playground from a snapshot.
export function buildTakes(part, running, act, begin) {
  for (const [button, what, name, type] of part.takes)
    button.addEventListener('click', () => act(() => take(running.address(what), name, type)));
  // The module of films is loaded when its section is opened.
  let films = null;
  const filmed = part.record.closest('details');
  const record = () =>
    filmed.open &&
    (films ??= import('../../share/record.js')
      .then(({ recordPlay }) =>
        recordPlay(part.record, running, () => ({
          width: part.pictures.clientWidth,
          height: part.pictures.clientHeight,
        })),
      )
      .catch(() => (films = null)));
  filmed.addEventListener('toggle', record);
  if (remembered('play-film')) filmed.open = true;
  part.load.addEventListener('change', async () => {
    const [file] = part.load.files;
    if (!file) return;
    await act(async () => begin({ rate: running.state?.rate, ...JSON.parse(await file.text()) }));
    part.load.value = ''; // cleared, so that choosing the same file again triggers an event
  });
}
