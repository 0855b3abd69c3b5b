// A poster: the server's picture with a line of text over its lower edge. The file keeps the server's metadata: the
// scene and the approximations.
const margin = 0.02; // margin, as a fraction of the width
const high = 0.018; // height of letters, as a fraction of the width

// The chunks of a PNG file; each includes its length, its name and its checksum.
function chunks(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset),
    all = [];
  for (let at = 8; at < bytes.length; ) {
    const size = 12 + view.getUint32(at),
      name = String.fromCharCode(...bytes.subarray(at + 4, at + 8));
    all.push({ name, data: bytes.subarray(at, at + size) });
    at += size;
  }
  return all;
}

const read = async blob => new Uint8Array(await blob.arrayBuffer());

function write(context, words, address, width, height) {
  const edge = margin * width,
    shade = context.createLinearGradient(0, height - 4 * high * width, 0, height);
  shade.addColorStop(0, '#0000');
  shade.addColorStop(1, '#000c');
  context.fillStyle = shade;
  context.fillRect(0, height - 4 * high * width, width, 4 * high * width);
  const font = size => (context.font = `${size}px system-ui, sans-serif`);
  font(0.7 * high * width);
  const right = context.measureText(address).width;
  context.fillStyle = '#aba396';
  context.fillText(address, width - edge - right, height - edge);
  font(high * width);
  const room = width - 3 * edge - right,
    needed = context.measureText(words).width;
  if (needed > room) font((high * width * room) / needed);
  context.fillStyle = '#ece8e1';
  context.fillText(words, edge, height - edge);
}

export async function captioned(picture, words, address) {
  const image = await createImageBitmap(picture, { colorSpaceConversion: 'none' }),
    { width, height } = image,
    canvas = new OffscreenCanvas(width, height),
    context = canvas.getContext('2d');
  context.drawImage(image, 0, 0);
  write(context, words, address, width, height);
  const [told, drawn] = await Promise.all([read(picture), canvas.convertToBlob({ type: 'image/png' }).then(read)]),
    texts = chunks(told).filter(({ name }) => ['tEXt', 'zTXt', 'iTXt'].includes(name)),
    [head, ...rest] = chunks(drawn);
  return new Blob([drawn.subarray(0, 8), ...[head, ...texts, ...rest].map(({ data }) => data)], { type: 'image/png' });
}
