// The triangles of a texture that cost most, as a table like all others of the page; a click on a row jumps there.

const mostCosts = 100;  // by each measure

const costColumns = [
  ['triangle', 'Triangle'], ['record', 'Record'], ['level', 'Level'], ['unknown_texels', 'Unknown area (texels)'],
  ['unknown_share', 'Unknown'], ['equal', 'Equal triangles'], ['bytes', 'Record (bytes)'], ['shared', 'Shared by'],
];

const grouped = (number) => number.toLocaleString('en');

// Of every distinct triangle: what it leaves to alpha tests, and the bytes of its record.
function costsOf(triangles, maps, size) {
  const costs = [];
  for (let t = 0; t < triangles.count; ++t) {
    const map = triangles.map[t];
    const unknownShare = map < 0 ? (map <= -3 ? 1 : 0) : maps.unknownShare(map);
    const unknown = triangles.area(t, size.width, size.height) * unknownShare * triangles.equals[t];
    costs.push({ t, map, unknownShare, unknown, bytes: map < 0 ? 0 : maps.bytes[map] });
  }
  return costs;
}

// The greatest by unknown area and by bytes, each triangle once, by unknown area.
function greatestCosts(costs) {
  const byArea = [...costs].sort((a, b) => b.unknown - a.unknown).slice(0, mostCosts);
  const byBytes = [...costs].sort((a, b) => b.bytes - a.bytes || b.unknown - a.unknown).slice(0, mostCosts);
  return [...new Set([...byArea, ...byBytes])].sort((a, b) => b.unknown - a.unknown);
}

function costRow(cost, triangles, maps) {
  const { t, map, unknown, unknownShare, bytes } = cost;
  const name = `${triangles.mesh[t]}/${triangles.primitive[t]}/${triangles.triangle[t]}`;
  const raw = [name, map < 0 ? '' : maps.record[map], map < 0 ? '' : maps.storedLevel[map], unknown.toFixed(2),
    unknownShare.toFixed(4), triangles.equals[t], bytes, map < 0 ? '' : maps.sharers[map]];
  const shown = [name, raw[1] === '' ? 'special' : grouped(raw[1]), raw[2], grouped(Math.round(unknown * 10) / 10),
    `${(100 * unknownShare).toFixed(1)} %`, grouped(raw[5]), grouped(bytes), raw[7] === '' ? '' : grouped(raw[7])];
  const cells = shown.map((text, k) => make('td', { class: k === 0 ? false : 'n' }, String(text)));
  cells[0].replaceChildren(make('button', { type: 'button', class: 'jump', title: 'Show this triangle' }, name));
  return make('tr', { 'data-csv': raw.join(','), 'data-triangle': t }, ...cells);
}

// `onJump(triangle)` hears of clicks.
function costTable(triangles, maps, size, onJump) {
  const costs = greatestCosts(costsOf(triangles, maps, size));
  const head = make('tr', { 'data-csv': costColumns.map(([key]) => key).join(',') },
    ...costColumns.map(([, name], k) => make('th', { scope: 'col', class: k === 0 ? false : 'n' }, name)));
  const body = make('tbody', {}, ...costs.map((cost) => costRow(cost, triangles, maps)));
  const table = make('table', {}, make('thead', {}, head), body);
  const button = make('button', { type: 'button', class: 'copy' }, 'Copy as CSV');
  body.addEventListener('click', (event) => {
    const row = event.target.closest('tr');
    if (row) onJump(Number(row.dataset.triangle));
  });
  makeSortable(table);
  makeCopyable(button, table);
  const caption = make('figcaption', {}, make('span', {}, 'The triangles that cost most (mesh/primitive/triangle)'), button);
  return make('figure', { class: 'table costs' }, caption, make('div', { class: 'scroll' }, table));
}
