// The page of `voxray pareto`: its matrix, a chart for each scene, its tables.

const off = new Set(); // methods that charts leave out
let chosenMethod = null; // that charts show before all others
let pictures = null; // parsed where the first one is shown

const methodName = (m) => data.methods[m].name;
const rivalMethod = () => data.rivals[state.rival];
const cost = () => data.costs[state.cost];
const errorName = () => data.errors[state.error].name;
const cellOf = (s, m) => data.factors[state.rival][state.cost][state.error][s][m];
const countOf = (s) => data.count[state.rival][state.cost][state.error][s];
const costWords = () => cost().label.replace(/, \w+$/, "");
const unit = () => cost().label.split(", ").pop();
const isOpen = ([, low, high]) => low <= 1 && (high === null || high >= 1);

function swatch(m) {
    const made = d3.create("svg").attr("class", "swatch").attr("viewBox", "-7 -7 14 14").attr("aria-hidden", "true");
    made.append("path").attr("d", data.methods[m].mark).attr("fill", `var(--${data.methods[m].color})`);
    return made.node();
}

// --- The matrix

function order() {
    const medians = data.medians[state.rival][state.cost][state.error];
    return d3.range(data.methods.length).sort((a, b) => (medians[b] ?? 0) - (medians[a] ?? 0));
}
function tell(s, m) {
    const cell = cellOf(s, m), who = `${methodName(m)} in ${data.scenes[s].name}`, rival = methodName(rivalMethod());
    if (m === rivalMethod()) return `${who}: what others are compared with.`;
    if (cell === null) return `${who}: not compared with ${rival}.`;
    if (cell === 0) return `${who}: reaches none of the ${countOf(s)} errors (${errorName()}) of ${rival}.`;
    const [value, low, high, reached] = cell;
    const open = isOpen(cell) ? "; that leaves open which is better" : "";
    const ends = `(${factorText(low)} to ${high === null ? "∞" : factorText(high)} within the intervals${open})`;
    const words = cost().key === "memory" ? `memory of ${rival} over its own at equal ${errorName()}: ${factorText(value)} ${ends}`
        : `${factorText(value)} times as fast as ${rival} at equal ${errorName()} ${ends}, by ${costWords()}`;
    return `${who}: ${words}. It reaches ${reached} of ${countOf(s)} errors.`;
}
function matrixCell(s, m, best) {
    const cell = cellOf(s, m);
    if (!cell) return { text: cell === 0 ? "–" : "", css: "empty" };
    const [value, , , reached] = cell, css = [isOpen(cell) && m !== rivalMethod() ? "open" : "", value === best ? "best" : "", 2 * reached < countOf(s) ? "few" : ""].join(" ");
    return { text: factorText(value), css, small: reached < countOf(s) && `${reached}/${countOf(s)}`, fold: value };
}
function showMatrix() {
    const rows = order(), rival = methodName(rivalMethod()), medians = data.medians[state.rival][state.cost][state.error];
    byId("versus").textContent = rival;
    byId("matrix-title").textContent = cost().key === "memory" ? `How many times less memory than ${rival} at equal ${errorName()}`
        : `Speed-up over ${rival} at equal ${errorName()}, by ${costWords()}`;
    const best = data.scenes.map((_, s) => d3.max(rows, (m) => (2 * (cellOf(s, m)?.[3] ?? 0) >= countOf(s) ? cellOf(s, m)?.[0] : 0)));
    drawMatrix(byId("matrix"), {
        columns: data.scenes.map((scene) => scene.name), totalName: "median",
        rows: rows.map((m) => ({ name: methodName(m), title: data.methods[m].chain, swatch: swatch(m), total: medians[m] === null ? "–" : factorText(medians[m]),
                                 cells: data.scenes.map((_, s) => matrixCell(s, m, best[s])) })),
        tell: (r, s) => tell(s, rows[r]),
        onPoint: (r, s) => {
            byId("cell").textContent = tell(s, rows[r]);
            byId("chain").textContent = `${data.methods[rows[r]].chain}. ${bestWords(s, rows[r])}`;
            byId("cell-images").replaceChildren(...imagesOf(s, bestOf(s, rows[r])));
        },
        onPick: (r, s) => pick(s, rows[r]),
    });
}
// The most accurate variant of a method
const bestOf = (s, m) => (data.scenes[s].fronts[state.cost][state.error][m] ?? []).slice(-1)[0];
function bestWords(s, m) {
    const scene = data.scenes[s], i = bestOf(s, m);
    if (i === undefined) return "";
    const costs = data.costs.map((one, c) => `${one.key} ${figures(scene.cost[c][i])} ${one.label.split(", ").pop()}`)
        .filter((_, c) => scene.cost[c][i] !== null);
    return `Its most accurate variant, ${scene.label[i]}: ${[...costs, ...data.errors.map(({ name }, e) => `${name} ${figures(scene.error[e][0][i])}`)].join(", ")}.`;
}
function pick(s, m) {
    off.delete(m);
    chosenMethod = m;
    showCharts(true);
    charts[s].figure.scrollIntoView({ block: "center", behavior: "instant" });
    charts[s].chart.select(bestOf(s, m));
    charts[s].plot.focus({ preventScroll: true });
}

// --- The charts

function contentOf(scene) {
    const [value, low, high] = scene.error[state.error], x = scene.cost[state.cost];
    const fronts = scene.fronts[state.cost][state.error], series = new Map();
    scene.method.forEach((m, index) => {
        if (off.has(m) || !(x[index] > 0 && value[index] > 0)) return;
        const isBold = m === rivalMethod() || m === chosenMethod;
        if (!series.has(m)) series.set(m, { ...data.methods[m], points: [], line: [], isBold, isFaint: chosenMethod !== null && !isBold });
        series.get(m).points.push({ index, x: x[index], y: value[index], low: low[index], high: high[index] });
    });
    const byIndex = new Map([...series.values()].flatMap((one) => one.points.map((p) => [p.index, p])));
    for (const [m, one] of series) one.line = (fronts[m] ?? []).map((index) => byIndex.get(index));
    const drawn = [...series.values()];
    const labels = drawn.filter((one) => one.line.length && !one.isFaint).sort((a, b) => b.isBold - a.isBold)
        .map((one) => ({ text: one.name, color: one.color, isBold: one.isBold, point: one.line[one.line.length - 1] }));
    return { series: drawn, labels, paths: drawn.map(({ line }) => line), xLabel: cost().label,
             front: scene.front[state.cost][state.error].map((index) => [x[index], value[index]]), yLabel: `${errorName()}, ${data.light} light`,
             text: `${scene.name}: ${errorName()} against ${cost().label}. ${frontWords(scene)}` };
}
function frontWords(scene) {
    const runs = [];
    for (const i of scene.front[state.cost][state.error]) {
        if (runs.length && scene.method[runs[runs.length - 1][0]] === scene.method[i]) runs[runs.length - 1].push(i);
        else runs.push([i]);
    }
    const span = (run, values) => [...new Set([run[0], run[run.length - 1]].map((i) => figures(values[i])))].join("–");
    const words = runs.map((run) => `${methodName(scene.method[run[0]])} ${span(run, scene.cost[state.cost])} ${unit()} → ${span(run, scene.error[state.error][0])}`);
    return `Front, from cheap to accurate: ${words.join("; ") || "nothing"}.`;
}
function makeFigure(scene, s) {
    const plot = element("div", { class: "plot" }), images = element("div", { class: "strip" }), words = element("figcaption", { class: "note" });
    const reset = element("button", { type: "button", class: "reset", onclick: () => chart.resetZoom() }, "Show all");
    const file = element("button", { type: "button", onclick: () => save(`${scene.name}.svg`, "image/svg+xml", chart.svg()) }, "Save SVG");
    const figure = element("figure", { class: "scene", id: `scene-${s}` }, element("h3", {}, scene.name, element("span", { class: "filter" }, reset, file)),
                           plot, images, words);
    const label = `Chart of ${scene.name}: arrow keys move along the fronts, + enlarges, Escape shows all`;
    const chart = makeChart(plot, label, ({ index, x, y, low, high }) => {
        images.replaceChildren(...imagesOf(s, index));
        return `${methodName(scene.method[index])} · ${scene.label[index]}: ${figures(x)} ${unit()}, ${errorName()} ${figures(y)} (${figures(low)} to ${figures(high)})`;
    });
    byId("scenes").append(figure);
    return { figure, plot, chart, words, scene };
}
function imagesOf(s, i) {
    pictures ??= JSON.parse(byId("pictures").textContent);
    const [image, map] = pictures[s][i] ?? [], [reference] = pictures[s].reference ?? [], name = methodName(data.scenes[s].method[i] ?? 0);
    const listed = image ? [[reference, "reference"], [image, name], [map, "its error (FLIP)"]] : [];
    return strip(listed.map(([uri, caption]) => [uri, caption, `${caption}, ${data.scenes[s].name}`]));
}
function showCharts(keepZoom = false) {
    for (const { chart, words, scene } of charts) {
        chart.update(contentOf(scene), keepZoom);
        words.textContent = frontWords(scene);
    }
    for (const button of byId("methods").querySelectorAll("button[data-method]")) {
        const m = Number(button.dataset.method);
        button.setAttribute("aria-pressed", !off.has(m));
        button.classList.toggle("highlighted", m === chosenMethod);
    }
    byId("everything").hidden = off.size === 0 && chosenMethod === null;
}

// --- Names and tables

byId("methods").append(...data.methods.map((method, m) => element("button", { type: "button", "data-method": m, title: method.chain, onclick: () => {
    if (!off.delete(m)) off.add(m);
    if (chosenMethod === m) chosenMethod = null;
    showCharts(true);
} }, swatch(m), method.name)), element("button", { type: "button", id: "everything", onclick: () => {
    off.clear();
    chosenMethod = null;
    showCharts(true);
} }, "Show all methods"));

const [speedUps, allVariants] = [...document.querySelectorAll("#tables details")].slice(-2);
const showSpeedUps = fillFolded(speedUps, () => data.scenes.flatMap((scene, s) => order().filter((m) => cellOf(s, m)).map((m) =>
    [methodName(m), scene.name, ...cellOf(s, m), countOf(s)])));
fillFolded(allVariants, () => data.scenes.flatMap((scene) => scene.label.map((label, i) =>
    [scene.name, methodName(scene.method[i]), label, ...scene.cost.map((costs) => costs[i]), ...scene.error.flatMap((error) => error.map((end) => end[i]))])));

drawScale(byId("scale"));
const charts = data.scenes.map(makeFigure);
readAddress();
let shownAxes = "";
onChange(["cost", "error", "rival"], () => {
    const axes = `${state.cost} ${state.error}`;
    showMatrix();
    for (const id of ["cell", "chain", "cell-images"]) byId(id).replaceChildren();
    showSpeedUps();
    showCharts(axes === shownAxes);
    shownAxes = axes;
});
