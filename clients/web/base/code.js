// The QR code of an address, as SVG.
import { svg } from './dom.js';
import { t } from '../words/i18n.js';

const quiet = 4; // minimum width of the white margin of a QR code, in modules (ISO/IEC 18004)

// Throws a readable sentence if the library cannot be loaded, or if the address is too long for a QR code.
export async function drawCode(url) {
  const drawn = await import('../vendor/lean-qr/nano.mjs').catch(() => {
    throw new Error(t('common.the-server-does-not', 'The server does not answer'));
  });
  let code;
  try {
    code = drawn.generate(url);
  } catch {
    throw new Error(t('code.the-link-is-too', 'The link is too long for a code.'));
  }
  const whole = code.size + 2 * quiet;
  let path = '';
  for (let y = 0; y < code.size; y++)
    for (let x = 0; x < code.size; x++) if (code.get(x, y)) path += `M${x + quiet} ${y + quiet}h1v1h-1z`;
  return svg(
    'svg',
    {
      viewBox: `0 0 ${whole} ${whole}`,
      role: 'img',
      'aria-label': t('code.qr-code-of-the', 'QR code of the link'),
      'shape-rendering': 'crispEdges',
    },
    svg('path', { d: `M0 0h${whole}v${whole}H0z`, fill: '#fff' }),
    svg('path', { d: path, fill: '#000' }),
  );
}
