'use strict';
// A frame, the exact frame and the error between them: a slider, and a zoom that shows the pixels' values.

const zoomRadius = 4;  // pixels about the chosen one
const zoomCell = 64;   // of the zoom's canvas
const names = {shown: 'frame', exact: 'exact frame', error: 'error map', blame: 'blamed steps'};

// Levels as they are stored: no colour management, no alpha.
async function pixelsOf(base64) {
  const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
  const bitmap = await createImageBitmap(new Blob([bytes], {type: 'image/png'}), {colorSpaceConversion: 'none', premultiplyAlpha: 'none'});
  const canvas = element('canvas', {width: bitmap.width, height: bitmap.height});
  const context = canvas.getContext('2d', {willReadFrequently: true});
  context.drawImage(bitmap, 0, 0);
  return {canvas, width: bitmap.width, height: bitmap.height, levels: context.getImageData(0, 0, bitmap.width, bitmap.height).data};
}

function errorPixels(shown, exact, amplification) {
  const canvas = element('canvas', {width: shown.width, height: shown.height});
  const image = new ImageData(shown.width, shown.height);
  for (let i = 0; i < image.data.length; ++i)
    image.data[i] = i % 4 === 3 ? 255 : Math.min(255, amplification * Math.abs(shown.levels[i] - exact.levels[i]));
  canvas.getContext('2d').putImageData(image, 0, 0);
  return {canvas, width: shown.width, height: shown.height, levels: image.data};
}

// The legend's entry of a colour.
const blamedStep = (levels) => {
  const colour = '#' + levels.map((level) => level.toString(16).padStart(2, '0')).join('');
  return page.report.blame.legend.find((entry) => entry.colour === colour);
};

const valuesAt = (pixels, x, y) => Array.from(pixels.levels.subarray(4 * (y * pixels.width + x), 4 * (y * pixels.width + x) + 3));

class PictureView {
  constructor() {
    this.split = 0.5;
    this.left = 'shown';
    this.right = 'error';
    this.amplification = page.amplification;
    this.canvas = element('canvas', {id: 'compare', tabindex: '0', 'aria-label': 'the two pictures, left and right of the slider'});
    this.divider = element('div', {class: 'divider'});
    this.slider = element('input', {type: 'range', id: 'slider', class: 'slider', min: '0', max: '1000', value: '500',
      'aria-label': 'where the left picture ends', oninput: () => { this.split = this.slider.valueAsNumber / 1000; this.draw(); }});
    this.zoom = element('canvas', {id: 'zoom', width: (2 * zoomRadius + 1) * zoomCell, height: (2 * zoomRadius + 1) * zoomCell});
    this.values = element('div', {id: 'pixel-values'});
    this.paper = element('div', {class: 'paper-pictures'});
    this.canvas.addEventListener('pointermove', (event) => this.point(event));
    this.canvas.addEventListener('pointerdown', (event) => this.point(event));
    this.canvas.addEventListener('keydown', (event) => this.step(event));
  }

  async load(picture) {
    this.pixels = {shown: await pixelsOf(picture.shown)};
    if (picture.exact) this.pixels.exact = await pixelsOf(picture.exact);
    if (picture.blame) this.pixels.blame = await pixelsOf(picture.blame);
    if (!this.pixels.exact) this.right = this.left = 'shown';
    const {width, height} = this.pixels.shown;
    this.canvas.width = width;
    this.canvas.height = height;
    if (this.x === undefined) {
      this.x = width >> 1;
      this.y = height >> 1;
    }
    this.refresh();
  }

  refresh() {
    if (this.pixels.exact) this.pixels.error = errorPixels(this.pixels.shown, this.pixels.exact, this.amplification);
    this.draw();
    this.drawZoom();
    this.paper.replaceChildren(...Object.entries(this.pixels).map(([kind, pixels]) => {
      const copy = element('canvas', {width: pixels.width, height: pixels.height});
      copy.getContext('2d').drawImage(pixels.canvas, 0, 0);
      return element('figure', {}, copy, element('figcaption', {}, names[kind] + (kind === 'error' ? `, times ${this.amplification}` : '')));
    }));
  }

  draw() {
    const {width, height} = this.canvas;
    const edge = Math.round(this.split * width);
    const context = this.canvas.getContext('2d');
    if (edge > 0) context.drawImage(this.pixels[this.left].canvas, 0, 0, edge, height, 0, 0, edge, height);
    if (edge < width) context.drawImage(this.pixels[this.right].canvas, edge, 0, width - edge, height, edge, 0, width - edge, height);
    this.divider.style.left = `calc(${100 * edge / width}% - 1px)`;
  }

  point(event) {
    const box = this.canvas.getBoundingClientRect();
    this.choose(Math.floor((event.clientX - box.left) / box.width * this.canvas.width),
        Math.floor((event.clientY - box.top) / box.height * this.canvas.height));
  }

  step(event) {
    const move = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]}[event.key];
    if (move === undefined) return;
    event.preventDefault();
    this.choose(this.x + move[0], this.y + move[1]);
  }

  choose(x, y) {
    this.x = Math.min(Math.max(x, 0), this.canvas.width - 1);
    this.y = Math.min(Math.max(y, 0), this.canvas.height - 1);
    this.drawZoom();
  }

  // What the pointer is on: the picture on its side of the slider.
  drawZoom() {
    const kind = this.x < Math.round(this.split * this.canvas.width) ? this.left : this.right;
    const pixels = this.pixels[kind];
    const context = this.zoom.getContext('2d');
    context.fillStyle = '#fff';
    context.fillRect(0, 0, this.zoom.width, this.zoom.height);
    context.font = '17px ui-monospace, "DejaVu Sans Mono", monospace';
    context.textAlign = 'center';
    for (let v = -zoomRadius; v <= zoomRadius; ++v)
      for (let u = -zoomRadius; u <= zoomRadius; ++u) this.drawCell(context, kind, u, v);
    context.strokeStyle = '#f0f';
    context.lineWidth = 3;
    context.strokeRect(zoomRadius * zoomCell + 1.5, zoomRadius * zoomCell + 1.5, zoomCell - 3, zoomCell - 3);
    this.showValues(kind);
  }

  drawCell(context, kind, u, v) {
    const pixels = this.pixels[kind];
    const [x, y] = [this.x + u, this.y + v];
    if (x < 0 || y < 0 || x >= pixels.width || y >= pixels.height) return;
    const [left, top] = [(u + zoomRadius) * zoomCell, (v + zoomRadius) * zoomCell];
    const levels = valuesAt(pixels, x, y);
    context.fillStyle = `rgb(${levels.join(',')})`;
    context.fillRect(left, top, zoomCell, zoomCell);
    context.fillStyle = 0.3 * levels[0] + 0.59 * levels[1] + 0.11 * levels[2] > 127 ? '#000' : '#fff';
    const told = kind === 'blame' ? [blamedStep(levels).value] : kind === 'error' ? this.difference(x, y).map(Math.abs) : levels;
    told.forEach((level, channel) => context.fillText(String(level), left + zoomCell / 2, top + 19 + 18 * channel));
  }

  difference(x, y) {
    const exact = valuesAt(this.pixels.exact, x, y);
    return valuesAt(this.pixels.shown, x, y).map((level, channel) => level - exact[channel]);
  }

  showValues(kind) {
    const {shown, exact} = this.pixels;
    const rows = [['frame', ...valuesAt(shown, this.x, this.y).map(String)]];
    if (exact) {
      rows.push(['exact', ...valuesAt(exact, this.x, this.y).map(String)]);
      rows.push(['difference', ...this.difference(this.x, this.y).map(String)]);
    }
    const blamed = this.pixels.blame ? ` Blamed here: ${blamedStep(valuesAt(this.pixels.blame, this.x, this.y)).name}.` : '';
    const shows = {error: ', with differences in levels', blame: ', with their numbers'}[kind] || '';
    this.values.replaceChildren(note(`Column ${this.x}, line ${this.y}; the zoom shows the ${names[kind]}${shows}.${blamed}`), table(['levels', '>R', '>G', '>B'], rows));
  }
}

async function picturesSection() {
  if (page.pictures.length === 0) return;
  const view = new PictureView();
  await view.load(page.pictures[0]);
  const kinds = Object.keys(view.pixels).map((kind) => [kind, names[kind]]);
  const controls = element('div', {class: 'controls'});
  if (page.pictures.length > 1)
    controls.append(select('frame', page.pictures.map((picture, k) => [k, `${picture.frame} (${picture.why})`]), 0, (k) => view.load(page.pictures[k])).label);
  if (view.pixels.exact) {
    controls.append(select('left', kinds, view.left, (kind) => { view.left = kind; view.draw(); view.drawZoom(); }).label,
        select('right', kinds, view.right, (kind) => { view.right = kind; view.draw(); view.drawZoom(); }).label,
        select('error times', [1, 8, 32, 128].map((times) => [times, String(times)]), view.amplification,
            (times) => { view.amplification = Number(times); view.refresh(); }).label);
  }
  section('The picture', controls,
      element('div', {class: 'pictures'},
          element('div', {}, element('div', {class: 'compare'}, view.canvas, view.divider), view.pixels.exact ? view.slider : null,
              note('Point at a pixel, or move with the arrow keys, to see its values and its neighbours\'.')),
          element('div', {class: 'zoom'}, view.zoom, view.values)),
      view.paper,
      note((view.pixels.exact ? 'The exact frame is the ideal one: the machine\'s own model in double. ' : 'No exact frame was rendered. ') +
          (page.left_out > 0 ? `${grouped(page.left_out)} more displayed frames are files beside this page.` : '')));
}
