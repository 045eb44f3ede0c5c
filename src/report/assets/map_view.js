// The interactive view of a page: textures, the triangles over them, and the maps of these.

const modes = [['states', 'Topmost'], ['mean', 'Mean of all'], ['overlaps', 'Overlaps']];

// How strongly the colours of a mode cover the alpha at first, percent.
const strengths = { states: 72, mean: 72, overlaps: 90 };

// From one to many: dark blue, green, yellow.
const heatStops = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];

function heatColour(share) {
  const at = Math.min(Math.max(share, 0), 1) * (heatStops.length - 1);
  const k = Math.min(Math.floor(at), heatStops.length - 2);
  return heatStops[k].map((low, c) => Math.round(low + (at - k) * (heatStops[k + 1][c] - low)));
}

// What the page holds of one texture, unpacked.
class TextureData {
  static async load(meta, [alpha, triangles, maps]) {
    const data = new TextureData();
    data.meta = meta;
    data.size = { width: meta.width, height: meta.height };
    data.image = new Image();
    data.image.src = `data:image/png;base64,${alpha.textContent}`;
    const [triangleBytes, mapBytes] = await Promise.all([unpackBytes(triangles), unpackBytes(maps), data.image.decode()]);
    data.triangles = new TriangleList(triangleBytes, meta.shown);
    data.maps = new MapList(mapBytes, meta.maps);
    data.copies = new Copies(meta, data.triangles);
    return data;
  }

  // The alpha of a texel, of one.
  alphaAt(x, y) {
    if (!this.alpha) {
      const canvas = make('canvas', { width: this.image.width, height: this.image.height });
      this.alpha = canvas.getContext('2d', { willReadFrequently: true });
      this.alpha.drawImage(this.image, 0, 0);
    }
    const part = this.image.width / this.size.width;
    return this.alpha.getImageData(Math.floor(x * part), Math.floor(y * part), 1, 1).data[0] / 255;
  }

  levelOf(t) {
    const map = this.triangles.map[t];
    return map < 0 ? -1 : this.maps.storedLevel[map];
  }

  // The copies over a point, topmost first, of triangles that are shown.
  copiesAt(x, y, isShown) {
    const hits = [];
    for (let k = this.copies.owners.length - 1; k >= 0; --k) {
      if (!isShown(this.copies.owners[k])) continue;
      const weights = this.copies.weightsAt(k, x, y);
      if (weights) hits.push({ copy: k, u: weights[0], v: weights[1] });
    }
    return hits;
  }
}

class MapView {
  constructor(root) {
    this.root = root;
    this.meta = JSON.parse(root.querySelector('script.meta').textContent);
    this.blobs = ['alpha', 'triangles', 'maps'].map((name) => [...root.querySelectorAll(`script.${name}`)]);
    this.mode = 'states';
    this.facts = new Facts(this.meta.kinds);
    this.build();
    this.stage = new Stage(this.host, (texel, isClick) => this.point(texel, isClick));
    this.host.addEventListener('keydown', (event) => this.onKey(event));
    this.setStrength(strengths.states);
    this.choose(0);
  }

  // ---- the page ----

  build() {
    this.host = make('div', { class: 'stage', tabindex: 0, role: 'application',
      'aria-label': 'Micro-triangles over the texture; arrows move, plus and minus zoom, 0 shows all' });
    this.filters = make('div', { class: 'filters' });
    this.note = make('p', { class: 'note' });
    this.costs = make('div');
    const panel = make('div', { class: 'panel' }, this.facts.element, this.filters);
    this.heat = make('div', { class: 'heat', hidden: true }, make('span', {}, '1'), make('i'), make('span', { class: 'most' }));
    const picture = make('div', { class: 'picture' }, this.toolbar(), this.host, this.heat, this.note);
    this.root.append(make('div', { class: 'columns' }, picture, panel), this.costs);
  }

  toolbar() {
    this.texture = make('select', { 'aria-label': 'Texture' },
      ...this.meta.textures.map((t, k) => make('option', { value: k }, `${t.name} (${grouped(t.triangles)} triangles)`)));
    this.texture.addEventListener('change', () => this.choose(Number(this.texture.value)));
    this.modes = make('select', { 'aria-label': 'What is drawn' },
      ...modes.map(([key, name]) => make('option', { value: key }, name)));
    this.modes.addEventListener('change', () => this.setMode(this.modes.value));
    this.strength = make('input', { type: 'range', min: 0, max: 100, value: strengths.states, 'aria-label': 'Strength of the colours' });
    this.strength.addEventListener('input', () => this.setStrength(this.strength.value));
    this.level = make('select', { 'aria-label': 'Finest level shown' });
    this.level.addEventListener('change', () => this.setLevel(Number(this.level.value)));
    const button = (text, title, act) => {
      const b = make('button', { type: 'button', title }, text);
      b.addEventListener('click', act);
      return b;
    };
    return make('div', { class: 'tools' }, this.texture,
      make('label', {}, 'Draw ', this.modes), make('label', {}, 'Level ', this.level), make('label', {}, 'Colour ', this.strength),
      make('span', { class: 'zoom' }, button('\u2212', 'Zoom out', () => this.stage.zoomMiddle(1 / 1.5)),
        button('+', 'Zoom in', () => this.stage.zoomMiddle(1.5)), button('Fit', 'Show all', () => this.stage.fit())));
  }

  async choose(number) {
    this.texture.value = number;
    this.root.dataset.ready = 'no';
    try {
      const data = await TextureData.load(this.meta.textures[number], this.blobs.map((list) => list[number]));
      if (Number(this.texture.value) === number) this.open(data);
    } catch (error) {
      this.note.textContent = `This browser cannot show the view: ${error.message}`;
    }
  }

  open(data) {
    this.data = data;
    this.hit = null;
    this.pinned = false;
    this.number = 0;
    this.visibleStates = this.meta.kinds.map(() => true);
    this.visibleLevels = new Set();
    this.palette = this.paletteNow();
    this.buildFilters();
    this.note.textContent = data.meta.note;
    this.costs.replaceChildren(costTable(data.triangles, data.maps, data.size, (t) => this.jump(t)));
    this.facts.show(null);
    this.stage.show(this.scene());
    this.root.dataset.ready = 'yes';
  }

  buildFilters() {
    const { triangles, maps, meta } = this.data;
    const counts = new Map();
    for (let t = 0; t < triangles.count; ++t) {
      const level = this.data.levelOf(t);
      counts.set(level, (counts.get(level) ?? 0) + 1);
    }
    const changed = () => this.changed();
    this.filters.replaceChildren(stateFilter(this.meta.kinds, meta.shares, this.visibleStates, changed),
      levelFilter(counts, this.visibleLevels, changed));
    const most = maps.level.reduce((a, b) => Math.max(a, b), 0);
    this.level.replaceChildren(make('option', { value: 12 }, 'as stored'),
      ...Array.from({ length: most }, (_, k) => make('option', { value: most - 1 - k }, `at most ${most - 1 - k}`)));
  }

  // ---- what is drawn ----

  isShown(t) { return this.visibleLevels.has(this.data.levelOf(t)); }

  scene() {
    return {
      size: this.data.size,
      image: this.data.image,
      smooth: !this.data.meta.nearest,
      start: (raster) => this.start(raster),
      marks: (context, view, ratio) => this.marks(context, view, ratio),
    };
  }

  start(raster) {
    const { copies, triangles, maps } = this.data;
    const isShown = (t) => this.isShown(t);
    if (this.mode === 'overlaps') {
      const most = Math.log(Math.max(2, this.data.meta.overlaps));
      return raster.overlaps(copies, isShown, (count) => packColour(heatColour(Math.log(count) / most), 255));
    }
    return raster[this.mode](copies, triangles, maps, isShown, this.palette);
  }

  paletteNow() { return new Palette(this.meta.kinds.map((kind) => kind.colour), this.visibleStates); }

  changed() {
    this.palette = this.paletteNow();
    if (this.hit) this.hit = this.completed(this.hit);
    this.facts.show(this.hit, this.pinned);
    this.stage.redraw();
  }

  setStrength(percentage) {
    this.strength.value = percentage;
    this.stage.layers[1].style.opacity = percentage / 100;
  }

  setMode(mode) {
    this.mode = mode;
    this.modes.value = mode;
    this.setStrength(strengths[mode]);
    this.heat.hidden = mode !== 'overlaps';
    this.heat.querySelector('.most').textContent = `${grouped(this.data.meta.overlaps)} triangles over a texel`;
    this.stage.redraw();
  }

  setLevel(level) {
    this.data.maps.showLevel(level);
    this.changed();
  }

  // ---- the pointer ----

  point(texel, isClick) {
    if (!this.data || (this.pinned && !isClick)) return;
    this.texel = texel;
    if (!isClick) this.number = 0;
    const before = this.hit;
    this.hit = this.hitAt(texel, this.number);
    if (isClick) this.pinned = this.hit !== null && !(this.pinned && before?.copy === this.hit.copy && before?.index === this.hit.index);
    this.refresh();
  }

  refresh() {
    this.facts.show(this.hit, this.pinned);
    this.stage.drawMarks();
  }

  hitAt(texel, number) {
    if (!texel) return null;
    const [x, y] = texel;
    const { width, height } = this.data.size;
    if (x < 0 || y < 0 || x >= width || y >= height) return null;
    const hits = this.data.copiesAt(x, y, (t) => this.isShown(t));
    if (hits.length === 0) return null;
    const k = ((number % hits.length) + hits.length) % hits.length;
    return this.completed({ ...hits[k], count: hits.length, number: k + 1, texel: [Math.floor(x), Math.floor(y)],
      alpha: this.data.alphaAt(x, y) });
  }

  // A hit with what its map says at the level that is shown.
  completed(hit) {
    const { triangles, maps, copies } = this.data;
    const t = copies.owners[hit.copy];
    const map = triangles.map[t];
    const level = map < 0 ? 0 : maps.shownLevel(map);
    const index = curveIndex(hit.u, hit.v, level);
    return { ...hit, t, map, level, index, triangles, maps, state: map < 0 ? -1 - map : maps.stateAt(map, index) };
  }

  onKey(event) {
    const steps = { '[': -1, ']': 1 };
    if (event.key in steps && this.texel) {
      this.number += steps[event.key];
      this.hit = this.hitAt(this.texel, this.number);
      this.refresh();
    } else if (event.key === 'Escape') {
      this.pinned = false;
      this.hit = null;
      this.refresh();
    }
  }

  // Brings a triangle into the middle and holds it.
  jump(t) {
    const k = this.data.copies.owners.indexOf(t);
    if (k < 0) return;
    const c = this.data.copies.corners.subarray(6 * k, 6 * k + 6);
    const xs = [c[0], c[2], c[4]];
    const ys = [c[1], c[3], c[5]];
    this.stage.fitBox(Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys), this.stage.width / 4);
    const middle = [(xs[0] + xs[1] + xs[2]) / 3, (ys[0] + ys[1] + ys[2]) / 3];
    this.texel = middle;
    const hits = this.data.copiesAt(...middle, (other) => this.isShown(other));
    const place = hits.findIndex((hit) => hit.copy === k);
    this.number = Math.max(place, 0);
    this.hit = this.hitAt(middle, this.number);
    this.pinned = this.hit !== null;
    this.host.scrollIntoView({ block: 'nearest' });
    this.refresh();
  }

  // The triangle and cell under the pointer, and all other triangles of the same record.
  marks(context, view, ratio) {
    if (!this.hit) return;
    const { copies, triangles } = this.data;
    const stroke = (points, colour, width) => {
      context.beginPath();
      for (let k = 0; k < 6; k += 2) context.lineTo(view.left + view.scale * points[k], view.top + view.scale * points[k + 1]);
      context.closePath();
      context.lineWidth = width * ratio;
      context.strokeStyle = colour;
      context.stroke();
    };
    const cornersOf = (k) => copies.corners.subarray(6 * k, 6 * k + 6);
    if (this.hit.map >= 0) {
      for (let k = 0; k < copies.owners.length; ++k) {
        if (triangles.map[copies.owners[k]] === this.hit.map) stroke(cornersOf(k), '#e0209f', 1.5);
      }
    }
    const own = cornersOf(this.hit.copy);
    stroke(own, '#fff', 5);
    stroke(own, '#101418', 2.5);
    const cell = this.cellOf(own);
    stroke(cell, '#fff', 4);
    stroke(cell, '#d4006a', 2);
  }

  // The corners of the hit's cell, in texels.
  cellOf(c) {
    const n = 2 ** this.hit.level;
    const lattice = cellCorners(this.hit.index);
    const points = [];
    for (let k = 0; k < 6; k += 2) {
      const u = lattice[k] / n;
      const v = lattice[k + 1] / n;
      points.push(c[0] + u * (c[2] - c[0]) + v * (c[4] - c[0]), c[1] + u * (c[3] - c[1]) + v * (c[5] - c[1]));
    }
    return points;
  }
}

const mapViews = [...document.querySelectorAll('.map-view')].map((root) => new MapView(root));

// For consoles and tests.
window.filigree = { views: mapViews, curveIndex, cellCorners };
