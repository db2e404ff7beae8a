// Rectangles side by side in rows, the highest first: the left and lower corner of each, and the
// size of all. sizes: [width, height] of each. widest: the width of all, if no rectangle is wider.
export function packed(sizes, widest) {
  const order = [...sizes.keys()].sort((a, b) => sizes[b][1] - sizes[a][1]);
  const places = [];
  let [x, y, row, total] = [0, 0, 0, 0];
  for (const each of order) {
    const [width, height] = sizes[each];
    if (x && x + width > widest) [x, y, row] = [0, y + row, 0];
    places[each] = [x, y];
    x += width;
    row = Math.max(row, height);
    total = Math.max(total, x);
  }
  return { places, size: [total, y + row] };
}
