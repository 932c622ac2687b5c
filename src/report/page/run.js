'use strict';
// The page of a run: the sections of report.txt, its pictures, and where each value of the configuration came from.

const report = page.report;

// Rows that follow each other, differ in a number of their names alone and say the same become one; of a kind with many
// rows those that `weight` ranks highest are shown, in their order.
const mostOfAKind = 12;
const kindOf = (name) => name.replace(/\d+/, '#');
const numberOf = (name) => Number((/\d+/.exec(name) || ['NaN'])[0]);

function merged(rows) {
  const told = (row) => JSON.stringify({...row, name: kindOf(row.name)});
  const runs = [];
  for (const row of rows) {
    const last = runs[runs.length - 1];
    if (last !== undefined && told(last.row) === told(row) && numberOf(row.name) === last.to + 1) last.to += 1;
    else runs.push({row, to: numberOf(row.name)});
  }
  return runs.map(({row, to}) => to > numberOf(row.name) ? {...row, name: row.name.replace(/\d+/, (from) => `${from}-${to}`)} : row);
}

function heaviest(allRows, weight) {
  const kinds = new Map();
  const rows = merged(allRows);
  for (const row of rows) {
    const kind = kindOf(row.name);
    if (!kinds.has(kind)) kinds.set(kind, []);
    kinds.get(kind).push(row);
  }
  const shown = new Set();
  let hidden = 0;
  for (const alike of kinds.values()) {
    const ranked = [...alike].sort((a, b) => weight(b) - weight(a)).slice(0, mostOfAKind);
    ranked.forEach((row) => shown.add(row));
    hidden += alike.length - ranked.length;
  }
  const text = hidden > 0 ? `${grouped(hidden)} more rows of the same kinds, which weigh less, are in report.json.` : null;
  return {rows: rows.filter((row) => shown.has(row)), rest: text === null ? null : note(text)};
}

const barHeight = (rows) => 70 + 22 * rows;
const percentAxis = (title, most) => ({min: 0, max: most, title: {display: true, text: title}});

// Draws a line across bars that lie, at 100 %.
const limitLine = {
  id: 'limit',
  afterDatasetsDraw(drawn) {
    const x = drawn.scales.x.getPixelForValue(100);
    const {top, bottom} = drawn.chartArea;
    drawn.ctx.save();
    drawn.ctx.strokeStyle = colours.ink;
    drawn.ctx.setLineDash([4, 3]);
    drawn.ctx.beginPath();
    drawn.ctx.moveTo(x, top);
    drawn.ctx.lineTo(x, bottom);
    drawn.ctx.stroke();
    drawn.ctx.restore();
  },
};

function answerSection() {
  const header = document.querySelector('header');
  header.querySelector('.answer').classList.add(report.answer.sustained ? 'good' : 'bad');
  for (const warning of report.warnings) header.append(element('p', {class: 'warning'}, 'Warning: ' + warning));
}

function rateSection() {
  const answer = report.answer;
  section('What is in the way of the rate',
      answer.limits.length === 0 ? note('Nothing: every unit keeps up.') : element('ul', {}, answer.limits.map((limit) => element('li', {}, limit))),
      table(['rate', '>Hz', 'meaning'], [
        ['required', quantity(answer.required_rate_hz), 'video.refresh_hz'],
        ['display', quantity(answer.display_rate_hz), 'frames scanned out, in whole pixel clocks'],
        ['update', quantity(answer.update_rate_hz), 'new pictures'],
      ]),
      note(`From the start of an animation frame to the first line of its picture: ${counted(answer.latency_frames, 'frame')}; ` +
          `${quantity(answer.latency_first_pixel_us)} us to its first pixel, ${quantity(answer.latency_last_pixel_us)} us to its last.`));
}

function unitsSection() {
  if (report.units.length === 0) return;
  const {rows, rest} = heaviest(report.units, (unit) => unit.busy + unit.blocked + unit.starved);
  const activities = ['busy', 'starved', 'blocked', 'idle'];
  const share = (unit, activity) => unit.cycles === 0 ? 0 : 100 * unit[activity] / unit.cycles;
  section('Where the cycles go',
      chart('units-chart', barHeight(rows.length), {
        type: 'bar',
        data: {
          labels: rows.map((unit) => unit.name),
          datasets: activities.map((activity) => ({
            label: activity, backgroundColor: colours[activity], data: rows.map((unit) => share(unit, activity)),
          })),
        },
        options: {
          indexAxis: 'y',
          scales: {x: {stacked: true, ...percentAxis('% of the unit\'s cycles', 100)}, y: {stacked: true, ticks: {autoSkip: false}}},
          plugins: {tooltip: {callbacks: {label: (item) => {
            const activity = activities[item.datasetIndex];
            return `${activity}: ${grouped(rows[item.dataIndex][activity])} cycles, ${item.parsed.x.toFixed(1)} %`;
          }}}},
        },
      }),
      rest,
      table(['unit', '>clock', '>cycles', '>busy', '>starved', '>blocked', '>idle'], rows.map((unit) =>
          [unit.name, scaled(unit.clock_hz, 'Hz'), grouped(unit.cycles), ...activities.map((activity) => grouped(unit[activity]))])),
      note('Cycles of each unit\'s own clock; the four add up to all of them.'));
}

function budgetsSection() {
  const budgets = report.budgets;
  if (budgets.length === 0) return;
  const part = (budget) => budget.available > 0 ? 100 * budget.used / budget.available : 0;
  const most = Math.min(250, Math.max(110, 10 * Math.ceil(Math.max(...budgets.map(part)) / 10)));
  const colour = (budget) => !budget.applies ? colours.muted : budget.fits ? colours.good : colours.bad;
  section('Budgets',
      chart('budgets-chart', barHeight(budgets.length), {
        type: 'bar',
        data: {
          labels: budgets.map((budget) => budget.name),
          datasets: [{label: '% of what there is', backgroundColor: budgets.map(colour), data: budgets.map(part)}],
        },
        options: {
          indexAxis: 'y',
          scales: {x: percentAxis('% of what there is', most), y: {ticks: {autoSkip: false}}},
          plugins: {
            legend: {display: false},
            tooltip: {callbacks: {label: (item) => {
              const budget = budgets[item.dataIndex];
              return `${quantity(budget.used)} of ${quantity(budget.available)} ${budget.unit}: ${percent(budget.used / budget.available)}`;
            }}},
          },
        },
        plugins: [limitLine],
      }),
      note('Green: fits. Red: does not. Grey: this machine does not depend on it; stated for comparison.'),
      table(['budget', '>used', '>available', 'unit', '>of it', 'fits', 'source', 'moved by'], budgets.map((budget) => [
        budget.name, quantity(budget.used), quantity(budget.available), budget.unit,
        budget.available > 0 ? percent(budget.used / budget.available) : '-',
        {text: budget.applies ? (budget.fits ? 'yes' : 'NO') : (budget.fits ? '(yes)' : '(NO)'), class: budget.applies && !budget.fits ? 'bad' : ''},
        {text: budget.source, class: 'wide'}, {text: budget.moved_by, class: 'wide code'},
      ]), {tall: true, class: 'moves'}));
}

function linksSection() {
  if (report.links.length === 0) return;
  const {rows, rest} = heaviest(report.links, (link) => link.utilisation);
  const ofPeak = (value, link) => link.peak_bytes_per_s > 0 ? 100 * value / link.peak_bytes_per_s : 0;
  section('Bandwidth of the links against their peaks',
      chart('links-chart', barHeight(1.6 * rows.length), {
        type: 'bar',
        data: {
          labels: rows.map((link) => link.name),
          datasets: [
            {label: 'over the run', backgroundColor: colours.busy, data: rows.map((link) => ofPeak(link.achieved_bytes_per_s, link))},
            {label: 'while active', backgroundColor: colours.muted, data: rows.map((link) => ofPeak(link.active_bytes_per_s, link))},
          ],
        },
        options: {
          indexAxis: 'y',
          scales: {x: percentAxis('% of the link\'s peak', 100), y: {ticks: {autoSkip: false}}},
          plugins: {tooltip: {callbacks: {label: (item) => {
            const link = rows[item.dataIndex];
            const value = item.datasetIndex === 0 ? link.achieved_bytes_per_s : link.active_bytes_per_s;
            return `${item.dataset.label}: ${scaled(value, 'B/s')} of ${scaled(link.peak_bytes_per_s, 'B/s')}`;
          }}}},
        },
      }),
      rest,
      table(['link', '>width', '>clock', '>moved', '>peak', '>while active', '>over the run', '>used'], rows.map((link) => [
        link.name, link.bits + ' bits', scaled(link.clock_hz, 'Hz'), grouped(link.bytes) + ' B', scaled(link.peak_bytes_per_s, 'B/s'),
        scaled(link.active_bytes_per_s, 'B/s'), scaled(link.achieved_bytes_per_s, 'B/s'), percent(link.utilisation),
      ])));
}

// Slack of every scan line; lines that have the retrace too would hide the others, so the axis ends above blanking.
function slackSection() {
  const deadlines = report.deadlines;
  if (deadlines === undefined) return;
  const {worst, available_cycles: blanking, slack_cycles: slack} = deadlines.lines;
  const least = Math.min(0, ...slack);
  section('What is left before each scan line',
      chart('slack-chart', 260, {
        type: 'line',
        data: {
          datasets: [
            {label: 'pixel clocks left, the least over the frames', stepped: 'middle', borderColor: colours.busy, borderWidth: 1.5, pointRadius: 0,
              data: slack.map((clocks, line) => ({x: line, y: clocks}))},
            {label: `worst: line ${worst.line}`, showLine: false, clip: false, pointRadius: 6, pointStyle: 'rectRot', borderColor: colours.bad,
              backgroundColor: colours.bad, data: [{x: worst.line, y: worst.slack_cycles}]},
          ],
        },
        options: {
          scales: {
            x: {type: 'linear', min: 0, max: Math.max(1, slack.length - 1), title: {display: true, text: 'scan line'}},
            y: {min: least, max: Math.max(blanking, least + 1), title: {display: true, text: 'pixel clocks'}},
          },
          interaction: {mode: 'nearest', axis: 'x', intersect: false},
        },
      }),
      note(`Horizontal blanking has ${grouped(blanking)} pixel clocks; a line that also has the vertical retrace lies above the chart. The worst is line ` +
          `${worst.line} of frame ${worst.frame}: ${quantity(worst.needed_cycles)} of ${quantity(worst.available_cycles)} pixel clocks are needed for ` +
          `${worst.needs}, ${quantity(worst.slack_cycles)} are left (${quantity(worst.slack_us)} us).`),
      table(['deadline', '>available', '>needed', '>left', 'in', 'for'], [
        ['vertical retrace', quantity(deadlines.retrace.available_cycles), quantity(deadlines.retrace.available_cycles - deadlines.retrace.slack_cycles),
          quantity(deadlines.retrace.slack_cycles), 'pixel clocks', deadlines.retrace.needs],
        ['hosts\' update', quantity(deadlines.host.used_cycles + deadlines.host.slack_cycles), quantity(deadlines.host.used_cycles),
          quantity(deadlines.host.slack_cycles), 'host cycles', 'links, arithmetic and bus of the slowest unit'],
      ]));
}

// What each pixel is compared of; reports of machines without boards do not know solids.
function thing() {
  return (report.modelled.solids || {made: 0}).made > 0 ? 'object' : 'triangle';
}

function errorSection() {
  const measured = report.images.filter((image) => image.errors.length > 0);
  if (measured.length === 0) return;
  const decibels = (value) => value === null ? 'infinite' : quantity(value) + ' dB';
  const meanings = [
    ['ideal', report.platform === 'imogene' ? 'the machine\'s own model in double' :
        'light at every pixel in double: the error of interpolation and arithmetic together'],
    ['snapped', 'the same given the snapped vertices'],
    ['true', 'perspective-correct normals, local viewer and lights'],
    ['sphere', 'the spheres themselves, where meshes stand for them'],
  ];
  section('Distance from the exact picture',
      table(['>frame', 'reference', '>missing', '>extra', '>other ' + thing(), '>largest', '>RMSE', '>PSNR', '>with outlines', '>over one level'],
          measured.flatMap((image) => image.errors.map((error) => [
            String(image.frame), error.reference, grouped(error.covered_missing), grouped(error.covered_extra), grouped(error.wrong_object),
            grouped(error.max_level), quantity(error.rmse_level), decibels(error.psnr_db), decibels(error.psnr_outline_db),
            quantity(error.over_one_level_percent) + ' %',
          ])), {tall: true}),
      note('Missing, extra and other ' + thing() + ' in pixels; largest and RMSE in levels (1/255 of a channel). ' +
          meanings.filter(([name]) => measured.some((image) => image.errors.some((error) => error.reference === name)))
              .map(([name, meaning]) => `${name}: ${meaning}`).join('; ') + '.'));
  partsSection();
}

// Where the pictures differ: of all frames the worst, and the mean.
function partsSection() {
  const asSeen = report.flip_pixels_per_degree !== null;
  const parts = [['everywhere', (errors) => errors], ['inside', (errors) => errors.inside],
    ['silhouettes', (errors) => errors.silhouettes], ['highlights', (errors) => errors.highlights]];
  const rows = (kind) => report.errors.flatMap((summary) => parts.map(([where, part]) => {
    const error = part(summary[kind]);
    return [summary.reference, where, quantity(error.compared), quantity(error.covered_missing), quantity(error.covered_extra),
      quantity(error.wrong_object), quantity(error.wrong_order), quantity(error.max_level), quantity(error.rmse_level), quantity(error.psnr_db),
      quantity(error.over_two_levels_percent), quantity(error.edge_jump_rms_level), quantity(error.flicker_rms_level),
      ...(asSeen ? [error.flip_mean, error.flip_p95, error.ciede2000_mean, error.ciede2000_p99].map(quantity) : [])];
  }));
  const headers = ['reference', 'where', '>compared', '>missing', '>extra', '>other ' + thing(), '>wrong order', '>largest', '>RMSE', '>PSNR, dB',
    '>over two levels, %', '>slope at edges', '>flicker', ...(asSeen ? ['>FLIP', '>95 %', '>CIEDE2000', '>99 %'] : [])];
  const many = report.images.length > 1;
  section(many ? 'Where the pictures differ: the worst of all frames, and the mean' : 'Where the pictures differ',
      table(headers, rows('worst')), many ? table(headers, rows('mean')) : null,
      note('Silhouettes: two pixels on either side of where the exact picture\'s surface ends; highlights: of the others, those to which it adds 32 levels of ' +
          'specular light; inside: the rest. Slope at edges: RMS in levels by which the slope of the levels jumps otherwise than it should where two ' +
          'triangles of a surface meet (Mach bands). Flicker: RMS change of the error from frame to frame where the exact levels stand still.' +
          (asSeen ? ` FLIP at ${quantity(report.flip_pixels_per_degree)} pixels a degree.` : '')));
}

function swatch(colour) {
  const made = element('span', {class: 'swatch'});
  made.style.backgroundColor = colour;
  return made;
}

function blameSection() {
  if (report.blame === undefined) return;
  const share = (fraction) => (100 * fraction).toFixed(1).replace(/^-0\.0$/, '0.0') + ' %';
  const entry = (name) => report.blame.legend.find((one) => one.name === name);
  const named = (name) => element('span', {}, swatch(entry(name).colour), ' ' + name);
  const others = report.blame.legend.filter((one) => !report.blame.frames[0].steps.some((step) => step.step === one.name));
  section('What made pixels wrong',
      table(['>frame', 'step', '>pixels', '>largest', '>removes', '>left: largest', '>RMSE', '>alone', '>alone: largest', '>99.9 %', '>mean', '>interaction', '>of worst'],
          report.blame.frames.flatMap((frame) => frame.steps.map((step) => [
            String(frame.frame), named(step.step), grouped(step.blamed_pixels), grouped(step.blamed_max_level), share(step.removed_share),
            grouped(step.left_max_level), quantity(step.left_rmse_level), share(step.alone_share), quantity(step.alone_max_level),
            quantity(step.alone_p999_level), quantity(step.alone_mean_level), share(step.interaction_share), quantity(step.of_largest_level),
          ])), {tall: true}),
      element('ul', {}, report.blame.frames.map((frame) => element('li', {},
          `Frame ${frame.frame}: ${grouped(frame.wrong)} of ${grouped(frame.pixels)} pixels are wrong; ${share(frame.interaction_share)} of the squares are no ` +
          `step's alone; ${grouped(frame.other_words)} pixels show words or tables of another pose, which no step is to blame for. Worst, where the right triangle is seen: ` +
          `${quantity(frame.largest_level)} levels at column ${frame.largest_column}, line ${frame.largest_line}.`))),
      note('Shares are of the squares of the differences from the ideal picture, levels not rounded. Removes: what goes where the step alone is made ' +
          'exact. Alone: what it makes where all others are. Interaction: the difference of both.'),
      element('p', {class: 'note'}, 'In the picture also: ', others.map((one) => element('span', {}, swatch(one.colour), ` ${one.name}: ${one.meaning}. `))));
}

function hardwareSection() {
  const total = report.memories.reduce((sum, memory) => sum + memory.total_bits, 0);
  section('Memory and logic that the machine has',
      table(['memory', '>instances', '>words', '>bits a word', '>total'], [
        ...report.memories.map((memory) =>
            [memory.name, grouped(memory.instances), grouped(memory.words), grouped(memory.bits_per_word), bits(memory.total_bits)]),
        ['together', '', '', '', bits(total)],
      ]),
      table(['logic', '>count', 'unit'], report.logic.map((logic) => [logic.name, grouped(logic.count), logic.unit])));
}

// A resolved file: tables, "key = value  # origin", and lists that go on over lines.
function configurationRows(text) {
  const rows = [];
  let group = '';
  let open = null;
  const close = (line) => {
    const mark = line.lastIndexOf('  # ');
    open.value += mark < 0 ? line : line.slice(0, mark);
    open.origin = mark < 0 ? '' : line.slice(mark + 4);
    rows.push(open);
    open = null;
  };
  for (const line of text.split('\n')) {
    if (open !== null) {
      if (line.startsWith(']')) close(line);
      else open.value += line;
      continue;
    }
    const header = /^\[+([^\]=]+)\]+$/.exec(line);
    const entry = /^([A-Za-z0-9_.]+) = (.*)$/.exec(line);
    if (header !== null) {
      group = header[1] + '.';
      if (line.startsWith('[[')) rows.push({heading: header[1]});
    } else if (entry !== null) {
      open = {key: group + entry[1], value: '', origin: ''};
      if (entry[2] === '[') open.value = '[';
      else close(entry[2]);
    }
  }
  return rows;
}

function configurationTable(text, changedOnly) {
  const rows = configurationRows(text).filter((row) => row.heading === undefined && (!changedOnly || row.origin !== 'default'));
  return table(['key', 'value', 'origin'], rows.map((row) => [{text: row.key, class: 'code'}, {text: row.value, class: 'wide code'}, row.origin]), {tall: true});
}

function configurationSection() {
  const place = element('div', {});
  const show = (changedOnly) => place.replaceChildren(
      element('h3', {}, 'Machine'), configurationTable(page.machine, changedOnly),
      element('h3', {}, 'Scene'), configurationTable(page.scene, changedOnly));
  const box = element('input', {type: 'checkbox', id: 'changed-only', onchange: () => show(box.checked)});
  show(false);
  section('Configuration', element('div', {class: 'controls'}, element('label', {}, box, 'only what differs from the defaults')), place,
      note(`SHA-256 of the machine: ${report.config_digest}; of the scene: ${report.scene_digest}.`));
}

function modelledSection() {
  const modelled = report.modelled;
  section('What was modelled',
      note(`${counted(report.frames, 'displayed frame')}. Triangles: ${grouped(modelled.objects.made)} made, ${grouped(modelled.objects.degenerate)} of zero ` +
          `area. Fragments: ${grouped(modelled.fragments.in)} = ${grouped(modelled.fragments.kept)} kept + ${grouped(modelled.fragments.hidden)} hidden.`),
      element('ul', {}, modelled.left_out.map((sentence) => element('li', {}, 'Left out: ' + sentence))));
}

answerSection();
picturesSection().then(() => {
  rateSection();
  unitsSection();
  budgetsSection();
  linksSection();
  slackSection();
  errorSection();
  blameSection();
  hardwareSection();
  configurationSection();
  modelledSection();
  pageIsWhole();
});
