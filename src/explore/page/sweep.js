'use strict';
// The page of a sweep: its points over two objectives of the reader's choice, filtered by parameter.

const mostTableRows = 2000;
const mostBoxes = 12;  // values of a parameter that get a box each; of more a range is chosen

// Of a row's figures the first are the objectives', the further ones count for nothing.
const shownFigures = [...page.objectives, ...page.further];
const figureOf = (row, place) => {
  const figure = row.figures[place];
  return figure === 'inf' ? Infinity : figure === '-inf' ? -Infinity : figure;
};
const figureText = (figure) => figure === null ? '-' : Number.isFinite(figure) ? quantity(figure) : 'infinite';
const withUnit = (text, unit) => unit === '' ? text : `${text} ${unit}`;
const named = (text, figure) => withUnit(text, figure.unit === '' ? '' : `(${figure.unit})`);
const axisTitle = (figure) => named(figure.name, figure) + (figure.most === undefined ? '' : figure.most ? ', most is wanted' : ', least is wanted');
// Of what is given one value is shown at first: the baseline's, else that of the front's first point.
const asked = page.baseline !== null ? page.rows[page.baseline] : page.rows.find((row) => row.front);
const shownAtFirst = (axis, k, v) => !axis.given || asked === undefined || asked.values[k] === v;

const view = {
  x: 0,
  y: Math.min(1, page.objectives.length - 1),
  logarithmic: {},
  allowed: page.axes.map((axis, k) => axis.values.map((_, v) => shownAtFirst(axis, k, v))),  // by the filter, a value each
  sort: {key: 'number', descending: false},
  chosen: page.baseline,
};
for (const axis of ['x', 'y']) view.logarithmic[axis] = shownFigures[view[axis]]?.logarithmic === true;
const rows = page.rows.map((row, index) => ({...row, index, met: row.allowed !== false}));
const thumbnails = new Map(page.thumbnails.map(({row, picture}) => [row, 'data:image/png;base64,' + page.pictures[picture]]));
const passes = (row) => row.values.every((value, axis) => view.allowed[axis][value]);
const isBaseline = (row) => row.index === page.baseline;

function pointLines(row) {
  return [
    `point ${row.number}${isBaseline(row) ? ', the baseline' : ''}${row.front ? ', on the front' : ''}`,
    ...page.axes.map((axis, k) => `${axis.path} = ${withUnit(axis.values[row.values[k]], axis.unit)}`),
    ...shownFigures.map((figure, k) => `${figure.name}: ${withUnit(figureText(figureOf(row, k)), figure.unit)}`),
    ...(row.met ? [] : ['breaks a constraint']),
    ...(row.beaten_by === undefined ? [] : [`beaten by point ${row.beaten_by}`]),
  ];
}

// What is given is the same for all points of a case.
const caseOf = (row) => row.values.filter((_, axis) => page.axes[axis].given).join(' ');

// Elements under what `key` gives for them, in the order of its first values.
function grouping(elements, key) {
  const found = new Map();
  for (const one of elements) {
    const own = key(one);
    if (!found.has(own)) found.set(own, []);
    found.get(own).push(one);
  }
  return found;
}

// A stair for each case, with gaps between them; none where a figure counts for nothing.
function stairs(shown) {
  if (Math.max(view.x, view.y) >= page.objectives.length) return [];
  return [...grouping(shown, caseOf).values()].map(stair).reduce((all, one) => all.length === 0 ? one : [...all, {x: NaN, y: NaN}, ...one], []);
}

// Of the points of a case that are shown and compared, those that no other beats in the two chosen objectives.
function stair(shown) {
  const [a, b] = [page.objectives[view.x], page.objectives[view.y]];
  const better = (objective) => objective.most ? -1 : 1;
  const points = shown.filter((row) => row.state === 'done' && row.met)
      .map((row) => ({x: figureOf(row, view.x), y: figureOf(row, view.y)}))
      .filter((point) => Number.isFinite(point.x) && Number.isFinite(point.y))
      .sort((p, q) => better(a) * (p.x - q.x) || better(b) * (p.y - q.y));
  const kept = [];
  for (const point of points)
    if (kept.length === 0 || better(b) * (point.y - kept[kept.length - 1].y) < 0) kept.push(point);
  return kept;
}

const hasCurves = page.axes.some((axis) => axis.curves.length > 0);
const ring = (colour, width) => ({fill: 'transparent', colour, width});
// Where points are drawn by curve, these only mark them.
const groups = [
  {label: 'beaten', ...(hasCurves ? ring('transparent', 0) : {colour: '#8fa3b8'}), radius: 3, order: 4, has: (row) => !row.front && row.met && !isBaseline(row)},
  {label: 'breaks a constraint', colour: '#d9a19b', radius: 3, order: 3, style: 'crossRot', has: (row) => !row.met && !isBaseline(row)},
  {label: 'on the front of all objectives', ...(hasCurves ? ring(colours.ink, 1.5) : {colour: colours.accent}), radius: hasCurves ? 8 : 5, order: 2, has: (row) => row.front && !isBaseline(row)},
  {label: 'baseline', ...(hasCurves ? ring(colours.baseline, 2) : {colour: colours.baseline}), radius: hasCurves ? 10 : 8, order: 1, style: 'triangle', has: isBaseline},
];

const curveColours = ['#6b7280', '#8b5fbf', '#c084d8', '#8fbde8', '#2563a8', '#0f8b8d', '#12365f', '#d97706', '#2f855a', '#c2410c', '#a08a00', '#d64b8a', '#b91c1c'];
const curveStyles = ['circle', 'rect', 'triangle', 'rectRot', 'star', 'crossRot'];

// Which curve a point is of: by its curve where the axis has any, else by its value, which is told where several are shown.
function curveName(row) {
  return page.axes.map((axis, k) => axis.curves.length > 0 ? axis.curves[row.values[k]] :
      view.allowed[k].filter(Boolean).length > 1 ? withUnit(axis.values[row.values[k]], axis.unit) : '').filter((part) => part !== '').join(', ');
}
const allCurves = hasCurves ? [...new Set(page.axes.flatMap((axis) => axis.curves))] : [];

function curveSets(drawable, place) {
  if (!hasCurves) return [];
  return [...grouping(drawable, curveName)].map(([label, own]) => {
    const number = Math.max(0, allCurves.findIndex((curve) => own[0].values.some((v, k) => page.axes[k].curves[v] === curve)));
    const colour = curveColours[number % curveColours.length];
    return {
      label, type: 'line', data: own.map((row) => ({x: place(row).x, y: place(row).y})), borderColor: colour, backgroundColor: colour, borderWidth: 1.5, fill: false,
      pointRadius: 4, pointHitRadius: 0, pointStyle: curveStyles[Math.floor(number / curveColours.length + number) % curveStyles.length], order: 6,
    };
  });
}

let scatter;

function scatterData() {
  const shown = rows.filter((row) => row.state === 'done' && passes(row));
  const drawable = shown.filter((row) => [view.x, view.y].every((objective) => {
    const figure = figureOf(row, objective);
    return figure !== null && Number.isFinite(figure);
  }));
  const place = (row) => ({x: figureOf(row, view.x), y: figureOf(row, view.y), row: row.index});
  return [
    ...groups.map((group) => ({
      label: group.label, data: drawable.filter(group.has).map(place), backgroundColor: group.fill || group.colour, borderColor: group.colour, borderWidth: group.width ?? 1,
      pointRadius: group.radius, pointHoverRadius: group.radius + 3, pointStyle: group.style || 'circle', order: group.order,
    })),
    {label: 'front of these two', type: 'line', data: stairs(shown), borderColor: colours.ink, borderWidth: 1, pointRadius: 0, pointHitRadius: 0, pointStyle: 'line',
      stepped: page.objectives[view.x]?.most === page.objectives[view.y]?.most ? 'before' : 'after', fill: false, order: 5},
    {label: 'chosen', data: drawable.filter((row) => row.index === view.chosen).map(place), pointRadius: hasCurves ? 13 : 11, pointStyle: 'circle', borderWidth: 2,
      backgroundColor: 'transparent', borderColor: colours.ink, order: 0},
    ...curveSets(drawable, place),
  ];
}

// Where curves are drawn, the legend has what is there.
function inLegend(item, data) {
  if (item.text === 'chosen') return false;
  return !hasCurves || (item.text !== 'beaten' && data.datasets[item.datasetIndex].data.length > 0);
}

// Some room about the points, but none below zero where no figure is.
function widened(scale) {
  if (scale.type === 'logarithmic') {
    const room = Math.max(1.05, (scale.max / scale.min) ** 0.04);
    scale.min /= room;
    scale.max *= room;
    return;
  }
  const room = 0.04 * (scale.max - scale.min);
  scale.min = scale.min >= 0 ? Math.max(0, scale.min - room) : scale.min - room;
  scale.max += room;
}

const scaleOf = (axis, objective) => ({
  type: view.logarithmic[axis] ? 'logarithmic' : 'linear', title: {display: true, text: axisTitle(shownFigures[objective])},
  bounds: 'data', afterDataLimits: widened, ticks: {maxRotation: 0},
  afterBuildTicks: (scale) => { scale.ticks = scale.ticks.filter((tick) => tick.value >= scale.min && tick.value <= scale.max); },
});

// The case that is shown, where it is one.
function titleOf() {
  const given = page.axes.map((axis, k) => [axis, view.allowed[k]]).filter(([axis]) => axis.given);
  const one = given.length > 0 && given.every(([, allowed]) => allowed.filter(Boolean).length === 1);
  const texts = one ? given.map(([axis, allowed]) => `${axis.name} ${withUnit(axis.values[allowed.indexOf(true)], axis.unit)}`) : [];
  return {display: one, text: texts.join(', '), font: {size: 14}};
}

function scatterConfiguration() {
  return {
    type: 'scatter',
    data: {datasets: scatterData()},
    options: {
      scales: {x: scaleOf('x', view.x), y: scaleOf('y', view.y)},
      interaction: {mode: 'nearest', intersect: true},
      onClick: (event, found) => {
        const point = found.map((item) => scatter.data.datasets[item.datasetIndex].data[item.index]).find((candidate) => candidate.row !== undefined);
        if (point !== undefined) choose(point.row);
      },
      plugins: {
        legend: {position: hasCurves && innerWidth > 900 ? 'right' : 'top', labels: {filter: inLegend, usePointStyle: true, boxHeight: hasCurves ? 7 : undefined}},
        title: titleOf(),
        tooltip: {
          filter: (item) => item.raw.row !== undefined && item.dataset.label !== 'chosen',
          callbacks: {label: (item) => pointLines(rows[item.raw.row])},
        },
      },
    },
  };
}

function refresh() {
  scatter.data.datasets = scatterData();
  scatter.options.scales.x = scaleOf('x', view.x);
  scatter.options.scales.y = scaleOf('y', view.y);
  scatter.options.plugins.title = titleOf();
  scatter.update();
  refreshThumbnails();
  refreshTable();
  refreshCounts();
}

function choose(index) {
  view.chosen = index;
  refresh();
  showChosen();
}

// Pages of sweeps.

function scatterSection() {
  const options = shownFigures.map((figure, k) => [k, named(figure.path, figure)]);
  const toggle = (axis) => {
    const box = element('input', {type: 'checkbox', id: `log-${axis}`, checked: view.logarithmic[axis], onchange: () => { view.logarithmic[axis] = box.checked; refresh(); }});
    return element('label', {}, box, 'logarithmic');
  };
  const pick = (axis) => {
    const {label, box} = select(axis === 'x' ? 'across' : 'up', options, view[axis], (figure) => {
      view[axis] = Number(figure);
      view.logarithmic[axis] = shownFigures[view[axis]].logarithmic === true;
      document.getElementById(`log-${axis}`).checked = view.logarithmic[axis];
      refresh();
    });
    box.id = `axis-${axis}`;
    return label;
  };
  section('Points', element('div', {class: 'controls'}, pick('x'), toggle('x'), pick('y'), toggle('y')), chart('scatter', hasCurves ? 560 : 460, scatterConfiguration),
      element('p', {class: 'note', id: 'counts'}), element('div', {id: 'chosen'}));
}

function refreshCounts() {
  const shown = rows.filter(passes);
  const done = shown.filter((row) => row.state === 'done');
  const missing = done.filter((row) => [view.x, view.y].some((objective) => !Number.isFinite(figureOf(row, objective) ?? NaN)));
  const texts = [`${counted(shown.length, 'point')} of ${grouped(rows.length)} pass the filter: ${grouped(shown.filter((row) => row.front).length)} on the front`];
  const add = (count, text) => { if (count > 0) texts.push(`${grouped(count)} ${text}`); };
  add(done.filter((row) => !row.met).length, 'against the constraints');
  add(shown.filter((row) => row.state === 'failed').length, 'failed');
  add(shown.filter((row) => row.state === 'waiting').length, 'not run yet');
  add(missing.length, 'not drawn, for want of a finite figure');
  document.getElementById('counts').textContent = texts.join(', ') + '. A click on a point chooses it.';
}

function showChosen() {
  const place = document.getElementById('chosen');
  if (view.chosen === null) return place.replaceChildren();
  const row = rows[view.chosen];
  const png = thumbnails.get(row.index);
  place.replaceChildren(
      element('h3', {}, `Point ${row.number}${isBaseline(row) ? ', the baseline' : ''}: ${row.state}`),
      png === undefined ? '' : element('img', {src: png, alt: '', width: 64, height: 64}),
      table(['parameter', 'value'], page.axes.map((axis, k) => [{text: axis.path, class: 'code'}, {text: withUnit(axis.values[row.values[k]], axis.unit), class: 'code'}])),
      table(['figure', '>value', 'unit', 'wanted'], shownFigures.map((figure, k) =>
          [{text: figure.path, class: 'code'}, figureText(figureOf(row, k)), figure.unit, figure.most === undefined ? '' : figure.most ? 'most' : 'least'])),
      note([row.error, row.front ? 'No point beats it.' : '', row.beaten_by === undefined ? '' : `Point ${row.beaten_by} beats it.`,
        row.met ? '' : 'It breaks a constraint.', row.digest === undefined ? '' : `Machine ${row.digest}..., scene ${row.scene}...`].filter(Boolean).join(' ')));
}

function boxesOf(axis, k) {
  return axis.values.map((value, v) => {
    const box = element('input', {type: 'checkbox', checked: view.allowed[k][v], 'data-axis': String(k), 'data-value': String(v),
      onchange: () => { view.allowed[k][v] = box.checked; refresh(); }});
    return element('label', {}, box, withUnit(value, axis.unit));
  });
}

// From one value to another, in the order of their numbers where they are numbers, else in the sweep's.
function rangeOf(axis, k) {
  const order = axis.values.map((_, v) => v);
  if (axis.values.every((value) => value !== '' && Number.isFinite(Number(value)))) order.sort((a, b) => Number(axis.values[a]) - Number(axis.values[b]));
  const allowed = order.map((v) => view.allowed[k][v]);
  const ends = {from: allowed.indexOf(true), to: allowed.lastIndexOf(true)};
  const options = order.map((v, place) => [place, withUnit(axis.values[v], axis.unit)]);
  const pick = (end) => select(end, options, ends[end], (place) => {
    ends[end] = Number(place);
    order.forEach((v, at) => { view.allowed[k][v] = at >= ends.from && at <= ends.to; });
    refresh();
  }).label;
  return [pick('from'), pick('to')];
}

function filterSection() {
  const varied = page.axes.map((axis, k) => [axis, k]).filter(([axis]) => axis.values.length > 1);
  if (varied.length === 0) return;
  section('Filter by parameter', element('div', {class: 'filters'}, varied.map(([axis, k]) =>
      element('fieldset', {}, element('legend', {}, axis.given ? `${axis.path}, given` : axis.path), ...(axis.values.length <= mostBoxes ? boxesOf(axis, k) : rangeOf(axis, k))))))
      .classList.add('no-paper');
}

function thumbnailSection() {
  if (thumbnails.size === 0) return;
  section('Pictures', element('div', {class: 'thumbnails tall', id: 'thumbnails'}),
      note(`The baseline, the front and some of the others: ${counted(thumbnails.size, 'picture')} of ${counted(rows.length, 'point')}.`));
}

function refreshThumbnails() {
  const place = document.getElementById('thumbnails');
  if (place === null) return;
  place.replaceChildren(...[...thumbnails].filter(([index]) => passes(rows[index])).map(([index, png]) => {
    const row = rows[index];
    const label = `${row.number}${isBaseline(row) ? ' baseline' : row.front ? ' front' : ''}`;
    return element('figure', {}, element('button', {class: index === view.chosen ? 'chosen' : null, title: pointLines(row).join('\n'),
      onclick: () => choose(index)}, element('img', {src: png, alt: `picture of point ${row.number}`})), element('figcaption', {}, label));
  }));
}

const columns = [
  {key: 'number', title: '>point', value: (row) => row.number, text: (row) => String(row.number)},
  {key: 'state', title: 'state', value: (row) => row.state, text: (row) => row.state === 'done' && !row.met ? 'against' : row.state},
  ...page.axes.map((axis, k) => ({key: 'axis' + k, title: '>' + axis.name, tip: axis.path, value: (row) => {
    const value = axis.values[row.values[k]];
    return Number.isFinite(Number(value)) ? Number(value) : value;
  }, text: (row) => axis.values[row.values[k]]})),
  ...shownFigures.map((figure, k) => ({key: 'figure' + k, title: '>' + named(figure.name, figure),
    tip: figure.path, value: (row) => figureOf(row, k), text: (row) => figureText(figureOf(row, k))})),
  {key: 'front', title: 'front', value: (row) => row.front ? 0 : row.beaten_by === undefined ? 2 : 1,
    text: (row) => row.front ? 'on it' : row.beaten_by === undefined ? row.error || '-' : `beaten by ${row.beaten_by}`},
];

// What is missing comes last, whichever way.
function byColumn(column, descending) {
  return (a, b) => {
    const [p, q] = [column.value(a), column.value(b)];
    if (p === null || q === null) return (p === null) - (q === null) || a.index - b.index;
    const order = typeof p === 'number' && typeof q === 'number' ? p - q : String(p) < String(q) ? -1 : String(p) > String(q) ? 1 : 0;
    return (descending ? -order : order) || a.index - b.index;
  };
}

function tableSection() {
  section('Table', element('div', {id: 'table'}),
      note('A click on a heading sorts. On paper the front and the baseline are printed; explore show --csv has every point.'));
}

function refreshTable() {
  const column = columns.find((candidate) => candidate.key === view.sort.key);
  const shown = rows.filter(passes).sort(byColumn(column, view.sort.descending));
  const made = table(columns.map((one) => one.title), shown.slice(0, mostTableRows).map((row) => columns.map((one) => one.text(row))), {tall: true});
  made.querySelectorAll('th').forEach((header, k) => {
    header.classList.add('sortable');
    if (columns[k].tip) header.title = columns[k].tip;
    if (columns[k] === column) header.append(view.sort.descending ? ' ▼' : ' ▲');
    header.addEventListener('click', () => {
      view.sort = {key: columns[k].key, descending: columns[k] === column && !view.sort.descending};
      refreshTable();
    });
  });
  made.querySelectorAll('tbody tr').forEach((line, k) => {
    const row = shown[k];
    line.classList.add(isBaseline(row) ? 'baseline' : row.front ? 'front' : row.met && row.state === 'done' ? 'beaten' : 'muted');
    line.addEventListener('click', () => choose(row.index));
  });
  const rest = shown.length - mostTableRows;
  document.getElementById('table').replaceChildren(made, ...(rest > 0 ? [note(`${grouped(rest)} more rows: filter, or sort another way.`)] : []));
}

for (const line of page.notes) document.querySelector('header').append(note(line));
if (page.constraints.length > 0) document.querySelector('header').append(note('Constraints: ' + page.constraints.join('; ')));
if (page.objectives.length > 0) scatterSection();
filterSection();
thumbnailSection();
tableSection();
const [title, , ...lines] = page.sensitivity.trim().split('\n');  // a heading, its rule, and what stands below
if (title !== '') section(title, element('div', {class: 'scroll'}, element('pre', {}, lines.join('\n'))));
pageIsWhole();
scatter = Chart.getChart('scatter');
if (scatter !== undefined) {
  refresh();
  showChosen();
} else {
  refreshThumbnails();
  refreshTable();
}
