'use strict';
// What the pages of runs and of sweeps share. Whatever comes from a file becomes text, never markup.

const page = JSON.parse(document.getElementById('data').textContent);
const colours = {
  busy: '#2563a8', starved: '#e0a030', blocked: '#b03a2e', idle: '#d9dde2',
  good: '#3d8b5f', bad: '#b03a2e', muted: '#b9c1ca', ink: '#1b2430', accent: '#2563a8', baseline: '#d97706',
};

// element('p', {class: 'note'}, 'text', otherElement, ...)
function element(tag, attributes, ...children) {
  const made = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes || {})) {
    if (value === false || value === undefined || value === null) continue;
    if (key.startsWith('on')) made.addEventListener(key.slice(2), value);
    else if (key in made && key !== 'list' && typeof value !== 'string') made[key] = value;
    else made.setAttribute(key, value);
  }
  for (const child of children.flat()) if (child !== null && child !== undefined) made.append(child);
  return made;
}

function section(title, ...children) {
  const made = element('section', {}, element('h2', {}, title), ...children);
  document.getElementById('page').append(made);
  return made;
}

const note = (text) => element('p', {class: 'note'}, text);

function select(label, options, chosen, onchange) {
  const box = element('select', {onchange: () => onchange(box.value)},
      options.map(([value, text]) => element('option', {value: String(value), selected: String(value) === String(chosen)}, text)));
  return {label: element('label', {}, label, box), box};
}

// Numbers as report.txt prints them.
function grouped(value) {
  return String(value).replace(/\B(?=(\d{3})+(?!\d))/g, ',');
}
const counted = (count, what) => `${grouped(count)} ${what}${count === 1 ? '' : 's'}`;
function quantity(value) {
  if (value === null || value === undefined) return '-';
  if (Number.isInteger(value)) return (value < 0 ? '-' : '') + grouped(Math.abs(value));
  const size = Math.abs(value);
  if (size < 1e-4 || size >= 1e9) return value.toExponential(3);
  if (size >= 1000) return quantity(Math.round(value));
  return String(Number(value.toPrecision(4)));
}
function percent(fraction) {
  if (fraction === null || fraction === undefined || !Number.isFinite(fraction)) return 'unlimited';
  const value = 100 * fraction;
  return (Math.abs(value) >= 10 ? quantity(Math.round(value)) : String(Number(value.toPrecision(2)))) + ' %';
}
function scaled(value, unit) {
  for (const prefix of ['', 'k', 'M', 'G']) {
    if (Math.abs(value) < 1000 || prefix === 'G') return Number(value.toPrecision(4)) + ' ' + prefix + unit;
    value /= 1000;
  }
  return '';
}
function bits(count) {
  if (count < 8192) return grouped(count) + ' bits';
  if (count < 1048576) return Number((count / 1024).toPrecision(4)) + ' Kibit';
  return Number((count / 1048576).toPrecision(4)) + ' Mibit';
}

// A header is a text; one that begins with '>' is of a column of numbers, to the right. A cell is a text, an element or
// {text, class}.
function table(headers, rows, options) {
  const right = headers.map((header) => header.startsWith('>'));
  const cell = (content, k) => {
    const told = content !== null && typeof content === 'object' && !(content instanceof Node);
    const classes = [right[k] ? 'right' : '', told && content.class ? content.class : ''].filter(Boolean).join(' ');
    return element('td', {class: classes || null}, told ? content.text : content);
  };
  return element('div', {class: ['scroll', options && options.tall ? 'tall' : '', (options && options.class) || ''].filter(Boolean).join(' ')},
      element('table', {},
          element('thead', {}, element('tr', {}, headers.map((header, k) =>
              element('th', {class: right[k] ? 'right' : null}, right[k] ? header.slice(1) : header)))),
          element('tbody', {}, rows.map((row) => element('tr', {}, row.map(cell))))));
}

// A chart takes its size from where it stands, so it is drawn when the page is; its configuration may be a function.
const waiting = [];
function chart(id, height, configuration) {
  const canvas = element('canvas', {id});
  const box = element('div', {class: 'chart'}, canvas);
  box.style.height = height + 'px';
  waiting.push(() => new Chart(canvas, typeof configuration === 'function' ? configuration() : configuration));
  return box;
}

function pageIsWhole() {
  Chart.defaults.animation = false;
  Chart.defaults.maintainAspectRatio = false;
  Chart.defaults.color = colours.ink;
  Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
  for (const draw of waiting) draw();
  window.addEventListener('beforeprint', () => Object.values(Chart.instances).forEach((drawn) => drawn.resize()));
  window.addEventListener('afterprint', () => Object.values(Chart.instances).forEach((drawn) => drawn.resize()));
  document.documentElement.dataset.ready = 'yes';
}
