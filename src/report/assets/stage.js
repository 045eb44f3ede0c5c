// The picture of one texture: three canvases over each other, and what moves the view. All lengths are pixels of the
// canvases unless a name says otherwise.

const mostPixels = 2.5e6;     // a larger canvas is drawn at a coarser ratio
const slice = 12;             // ms of drawing between two looks at the input
const patience = 60;          // ms of drawing before a coarse picture bridges the wait
const coarseness = 4;
const margin = 12;
const mostScale = 4096;       // pixels a texel

const make = (tag, attributes = {}, ...children) => {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === true) element.setAttribute(name, '');
    else if (value !== false && value !== null) element.setAttribute(name, value);
  }
  element.append(...children);
  return element;
};

// Runs a generator until it ends or `ms` are over; whether it ended.
function advance(generator, ms) {
  const until = performance.now() + ms;
  while (performance.now() < until) {
    for (let k = 0; k < 16; ++k) {
      if (generator.next().done) return true;
    }
  }
  return false;
}

class Stage {
  // `scene` paints: size {width, height} in texels, image, smooth, start(raster) a generator that fills it,
  // marks(context, view). `onPoint(texel or null, isClick)` hears of the pointer.
  constructor(host, onPoint) {
    this.host = host;
    this.onPoint = onPoint;
    this.layers = ['base', 'cells', 'marks'].map((name) => make('canvas', { class: name }));
    host.append(...this.layers);
    this.contexts = this.layers.map((canvas) => canvas.getContext('2d'));
    this.view = { scale: 1, left: 0, top: 0 };
    this.ticket = 0;
    this.pointers = new Map();
    this.listen();
    new ResizeObserver(() => this.resize()).observe(host);
  }

  show(scene) {
    this.scene = scene;
    this.forget();
    this.resize();
    this.fit();
  }

  // What is drawn belongs to another picture.
  forget() {
    this.drawnView = null;
    if (this.width) this.contexts[1].clearRect(0, 0, this.width, this.height);
  }

  resize() {
    const { width, height } = this.host.getBoundingClientRect();
    if (width === 0 || !this.scene) return;
    const wanted = Math.min(window.devicePixelRatio || 1, 2);
    this.ratio = Math.min(wanted, Math.sqrt(mostPixels / (width * height)));
    const w = Math.round(width * this.ratio);
    const h = Math.round(height * this.ratio);
    if (this.width === w && this.height === h) return;
    const before = this.width;
    [this.width, this.height] = [w, h];
    for (const canvas of this.layers) [canvas.width, canvas.height] = [w, h];
    this.drawnView = null;
    if (before) this.redraw();
    else this.fit();
  }

  // ---- the view ----

  fit() {
    const { width, height } = this.scene.size;
    this.fitBox(0, 0, width, height, margin * 2);
  }

  // Brings a box of texels into the middle.
  fitBox(x0, y0, x1, y1, space) {
    if (!this.width) return;
    const scale = Math.min((this.width - space) / Math.max(x1 - x0, 1e-6), (this.height - space) / Math.max(y1 - y0, 1e-6));
    this.view.scale = Math.min(scale, mostScale);
    this.view.left = this.width / 2 - (this.view.scale * (x0 + x1)) / 2;
    this.view.top = this.height / 2 - (this.view.scale * (y0 + y1)) / 2;
    this.redraw();
  }

  zoomAt(x, y, factor, since) {
    const { width, height } = this.scene.size;
    const least = Math.min(this.width / width, this.height / height) / 4;
    const scale = Math.min(Math.max(this.view.scale * factor, least), mostScale);
    const change = scale / this.view.scale;
    this.view.left = x - change * (x - this.view.left);
    this.view.top = y - change * (y - this.view.top);
    this.view.scale = scale;
    this.redraw(since);
  }

  zoomMiddle(factor) { this.zoomAt(this.width / 2, this.height / 2, factor); }

  pan(dx, dy) {
    this.view.left += dx;
    this.view.top += dy;
    this.redraw();
  }

  texelAt(x, y) { return [(x - this.view.left) / this.view.scale, (y - this.view.top) / this.view.scale]; }

  // ---- drawing ----

  // Draws everything at the next frame. `since` is when the wish arose, for the time it takes to answer it.
  redraw(since = performance.now()) {
    this.since = this.since ?? since;
    if (this.frame || !this.scene || !this.width) return;
    this.frame = requestAnimationFrame(() => {
      this.frame = null;
      this.draw(this.since);
      this.since = null;
    });
  }

  raster(part) {
    const { scale, left, top } = this.view;
    const view = { scale: scale / part, left: left / part, top: top / part };
    return new Raster(Math.ceil(this.width / part), Math.ceil(this.height / part), view, this.scene.size);
  }

  // At once the old cells, moved and scaled to the new view; then the new ones, piece by piece.
  draw(since) {
    const ticket = ++this.ticket;
    const begun = performance.now();
    this.moveCells();
    this.drawBase();
    this.drawMarks();
    this.note(since, false);
    const fine = this.raster(1);
    const steps = this.scene.start(fine);
    let bridged = false;
    const goOn = () => {
      if (ticket !== this.ticket) return;
      if (advance(steps, slice)) {
        this.showCells(() => this.contexts[1].putImageData(fine.image(), 0, 0));
        this.note(since, true);
        return;
      }
      if (!bridged && performance.now() - begun > patience) {
        bridged = true;
        this.showCells(() => this.drawCoarse());
      }
      setTimeout(goOn);
    };
    setTimeout(goOn);
  }

  showCells(draw) {
    draw();
    this.drawnView = { ...this.view };
    this.layers[1].style.transform = '';
  }

  moveCells() {
    if (!this.drawnView) return;
    const times = this.view.scale / this.drawnView.scale;
    const x = (this.view.left - times * this.drawnView.left) / this.ratio;
    const y = (this.view.top - times * this.drawnView.top) / this.ratio;
    this.layers[1].style.transform = `translate(${x}px, ${y}px) scale(${times})`;
  }

  drawCoarse() {
    const raster = this.raster(coarseness);
    advance(this.scene.start(raster), Infinity);
    const small = make('canvas', { width: raster.width, height: raster.height });
    small.getContext('2d').putImageData(raster.image(), 0, 0);
    const context = this.contexts[1];
    context.clearRect(0, 0, this.width, this.height);
    context.imageSmoothingEnabled = false;
    context.drawImage(small, 0, 0, raster.width * coarseness, raster.height * coarseness);
  }

  // Leaves on the element how long the answer took, ms: first to anything, then to the whole picture.
  note(since, whole) {
    const ms = (performance.now() - since).toFixed(1);
    const data = this.host.dataset;
    if (data.ticket !== String(this.ticket)) {
      data.ticket = this.ticket;
      data.answered = ms;
      delete data.drawn;
    }
    if (whole) data.drawn = ms;
  }

  drawBase() {
    const context = this.contexts[0];
    context.clearRect(0, 0, this.width, this.height);
    const { image, size, smooth } = this.scene;
    const { scale, left, top } = this.view;
    context.imageSmoothingEnabled = smooth;
    // The part in sight with a texel around it, since very large targets lose precision.
    const x0 = Math.max(0, Math.floor(-left / scale) - 1);
    const y0 = Math.max(0, Math.floor(-top / scale) - 1);
    const x1 = Math.min(size.width, Math.ceil((this.width - left) / scale) + 1);
    const y1 = Math.min(size.height, Math.ceil((this.height - top) / scale) + 1);
    if (x1 <= x0 || y1 <= y0) return;
    const part = image.width / size.width;
    context.drawImage(image, x0 * part, y0 * part, (x1 - x0) * part, (y1 - y0) * part,
      left + scale * x0, top + scale * y0, scale * (x1 - x0), scale * (y1 - y0));
  }

  drawMarks() {
    this.contexts[2].clearRect(0, 0, this.width, this.height);
    this.scene.marks(this.contexts[2], this.view, this.ratio);
  }

  // ---- input ----

  listen() {
    const on = (name, handler, options) => this.host.addEventListener(name, handler, options);
    on('wheel', (event) => this.onWheel(event), { passive: false });
    on('pointerdown', (event) => this.onDown(event));
    on('pointermove', (event) => this.onMove(event));
    on('pointerup', (event) => this.onUp(event));
    on('pointercancel', (event) => this.pointers.delete(event.pointerId));
    on('pointerleave', (event) => { if (this.pointers.size === 0 && event.pointerType === 'mouse') this.onPoint(null, false); });
    on('dblclick', (event) => this.zoomAt(...this.placeOf(event), event.shiftKey ? 0.5 : 2));
    on('keydown', (event) => this.onKey(event));
  }

  placeOf(event) {
    const box = this.host.getBoundingClientRect();
    return [(event.clientX - box.left) * this.ratio, (event.clientY - box.top) * this.ratio];
  }

  onWheel(event) {
    event.preventDefault();
    const step = event.deltaMode === 1 ? 30 : 1;
    this.zoomAt(...this.placeOf(event), 2 ** (-event.deltaY * step / 240), event.timeStamp);
  }

  onDown(event) {
    this.host.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, this.placeOf(event));
    this.moved = this.pointers.size > 1 ? Infinity : 0;
  }

  onMove(event) {
    const place = this.placeOf(event);
    const before = this.pointers.get(event.pointerId);
    if (!before) {
      this.onPoint(this.texelAt(...place), false);
      return;
    }
    this.pointers.set(event.pointerId, place);
    if (this.pointers.size === 2) {
      this.pinch(event.pointerId, before, place);
      return;
    }
    this.moved += Math.hypot(place[0] - before[0], place[1] - before[1]);
    if (this.moved > 4 * this.ratio) this.pan(place[0] - before[0], place[1] - before[1]);
  }

  pinch(id, before, now) {
    const other = [...this.pointers].find(([key]) => key !== id)[1];
    const far = (p) => Math.max(1, Math.hypot(p[0] - other[0], p[1] - other[1]));
    this.view.left += (now[0] - before[0]) / 2;
    this.view.top += (now[1] - before[1]) / 2;
    this.zoomAt((now[0] + other[0]) / 2, (now[1] + other[1]) / 2, far(now) / far(before));
  }

  onUp(event) {
    const place = this.pointers.get(event.pointerId);
    this.pointers.delete(event.pointerId);
    if (place && this.moved <= 4 * this.ratio) this.onPoint(this.texelAt(...place), true);
  }

  onKey(event) {
    const step = Math.min(this.width, this.height) / 8;
    const actions = {
      '+': () => this.zoomMiddle(1.5), '=': () => this.zoomMiddle(1.5), '-': () => this.zoomMiddle(1 / 1.5),
      0: () => this.fit(), ArrowLeft: () => this.pan(step, 0), ArrowRight: () => this.pan(-step, 0),
      ArrowUp: () => this.pan(0, step), ArrowDown: () => this.pan(0, -step),
    };
    if (!actions[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    actions[event.key]();
  }
}
