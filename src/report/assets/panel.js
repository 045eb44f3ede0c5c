// What stands beside the picture: what lies under the pointer, and the filters, which are histograms too.

const stateText = (kinds, state) => [
  make('i', { class: 'swatch', style: `background:rgb(${kinds[state].colour})` }), kinds[state].name,
];

const percent = (share) => `${(100 * share).toFixed(share > 0 && share < 0.001 ? 3 : 1)} %`;

// A row of a filter: a box to tick, its name, a bar as long as its share of the longest, a figure.
function filterRow(name, share, text, onChange) {
  const box = make('input', { type: 'checkbox', checked: true });
  box.addEventListener('change', () => onChange(box.checked));
  const bar = make('span', { class: 'bar' }, make('span', { style: `width:${(100 * share).toFixed(2)}%` }));
  return make('label', {}, box, make('span', { class: 'name' }, ...name), bar, make('span', { class: 'value' }, text));
}

function filterList(title, rows) {
  return make('fieldset', {}, make('legend', {}, title), ...rows);
}

function stateFilter(kinds, shares, visible, onChange) {
  const longest = Math.max(...shares, 1e-9);
  return filterList('States, by area', kinds.map((kind, s) => filterRow(stateText(kinds, s), shares[s] / longest,
    percent(shares[s]), (on) => {
      visible[s] = on;
      onChange();
    })));
}

// `counts` is a Map from level, or -1 for triangles without a map, to how many distinct triangles have it.
function levelFilter(counts, visible, onChange) {
  const longest = Math.max(...counts.values(), 1);
  const levels = [...counts.keys()].sort((a, b) => a - b);
  return filterList('Levels, by distinct triangles', levels.map((level) => {
    visible.add(level);
    const name = level < 0 ? 'special index' : `level ${level}`;
    return filterRow([name], counts.get(level) / longest, grouped(counts.get(level)), (on) => {
      if (on) visible.add(level);
      else visible.delete(level);
      onChange();
    });
  }));
}

// The facts about a hit, as [key, name, nodes].
function factsOf(hit, kinds) {
  const { triangles, maps, t, map } = hit;
  const place = `mesh ${triangles.mesh[t]}, primitive ${triangles.primitive[t]}, triangle ${triangles.triangle[t]}`;
  const equals = triangles.equals[t] > 1 ? `, and ${grouped(triangles.equals[t] - 1)} like it` : '';
  const facts = [
    ['triangle', 'Triangle', [place + equals]],
    ['state', 'State', stateText(kinds, hit.state)],
  ];
  if (map < 0) {
    facts.push(['index', 'Micro-triangle', ['the whole triangle']], ['record', 'Record', [`special index ${map}`]]);
  } else {
    const shown = hit.level < maps.storedLevel[map] ? `, shown at level ${hit.level}` : '';
    facts.push(
      ['index', 'Micro-triangle', [`${grouped(hit.index)} of ${grouped(4 ** hit.level)}`]],
      ['record', 'Record', [`${grouped(maps.record[map])}, level ${maps.storedLevel[map]}${shown}, ${maps.states[map]} states, ` +
        `${grouped(maps.bytes[map])} bytes, shared by ${grouped(maps.sharers[map])} triangle${maps.sharers[map] === 1 ? '' : 's'}`]]);
  }
  facts.push(
    ['barycentrics', 'Barycentrics', [[1 - hit.u - hit.v, hit.u, hit.v].map((b) => b.toFixed(4)).join(', ')]],
    ['alpha', 'Alpha', [`${hit.alpha.toFixed(3)} at texel ${hit.texel.join(', ')}`]],
    ['overlaps', 'Over this point', [hit.count === 1 ? 'this triangle alone'
      : `${grouped(hit.count)} distinct triangles, this is number ${hit.number} from the top ([ and ] go through them)`]]);
  return facts;
}

class Facts {
  constructor(kinds) {
    this.kinds = kinds;
    this.element = make('dl', { class: 'facts', 'aria-live': 'polite' });
    this.show(null);
  }

  show(hit, pinned) {
    if (!hit) {
      this.element.replaceChildren(make('dt', {}, 'Point at a triangle'),
        make('dd', {}, 'to see its state and record; a click holds it. Wheel or pinch zooms, dragging moves; keys: arrows, +, -, 0.'));
      return;
    }
    const rows = factsOf(hit, this.kinds).flatMap(([key, name, nodes]) => [
      make('dt', {}, name), make('dd', { 'data-fact': key }, ...nodes),
    ]);
    if (pinned) rows.push(make('dt', {}, 'Held'), make('dd', {}, 'click it again, or anything else, to let go'));
    this.element.replaceChildren(...rows);
  }
}
