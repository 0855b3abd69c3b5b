// What can be taken from a playground, numbers, a snapshot and films, and the snapshot that can be brought back.
import { remembered } from './job.js';
import { take } from './server.js';

// part: of playground-parts.js; running: running.js; act(task) tells what is wrong; begin(snapshot).
export function buildTakes(part, running, act, begin) {
  for (const [button, what, name, type] of part.takes)
    button.addEventListener('click', () => act(() => take(running.address(what), name, type)));
  // Films, once somebody looks.
  let films = null;
  const filmed = part.record.closest('details');
  const record = () =>
    filmed.open &&
    (films ??= import('./record.js')
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
    part.load.value = ''; // the same file may be chosen once more
  });
}
