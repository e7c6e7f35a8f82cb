// The report's charts, error against time of all variants and numbers over frames, and keys for the whole page; then the page is what
// its address says.

// What the filter keeps is drawn as it is, the rest faint
const isFaint = (i) => matching !== null && !matching.has(data.variants[i].number);

function errorContent(chart) {
    const [value, low, high] = chart.error, [time, fast, slow] = data.times[chart.time], marked = new Set(chart.marked);
    const points = new Map(chart.drawn.map((i) => [i, {
        index: i, x: time[i], xLow: fast[i], xHigh: slow[i], y: value[i], low: low[i], high: high[i], isFaint: isFaint(i) }]));
    const series = d3.nest().key((p) => data.variants[p.index].color + data.variants[p.index].mark).entries([...points.values()])
        .map(({ values }) => ({ ...data.variants[values[0].index], points: values, marks: values.filter((p) => marked.has(p.index)),
                                line: data.joined ? [...values].sort((a, b) => a.x - b.x) : [] }));
    return { ...chart, series, hasBars: true, front: chart.front.map((i) => [time[i], high[i]]),
             paths: [chart.marked.map((i) => points.get(i)).sort((a, b) => a.x - b.x)],
             labels: chart.labelled.map((i) => ({ text: data.variants[i].label, color: data.variants[i].color, point: points.get(i) })) };
}
function lineContent(chart) {
    const series = chart.lines.map(([i, frames, values]) => {
        const line = frames.map((frame, k) => ({ index: `${i} ${frame}`, variant: i, x: frame, y: values[k], low: values[k], high: values[k] }));
        return { ...data.variants[i], points: line, line };
    });
    return { ...chart, series, isLinear: true, front: [], levels: [], paths: series.map(({ line }) => line), labels: [] };
}
const variantOf = (point) => data.variants[point.variant ?? point.index];
function pointWords(point) {
    const interval = point.low < point.high ? ` (${figures(point.low)} to ${figures(point.high)})` : "";
    return `${variantOf(point).name}: ${figures(point.x)}${point.variant === undefined ? " ms" : ""}, ${figures(point.y)}${interval}`;
}

const drawn = [...document.querySelectorAll(".plot")].map((host) => {
    const shown = data.charts[Number(host.dataset.chart)];
    return { host, shown, chart: makeChart(host, `${shown.text}; arrow keys move, Enter leads to a variant`, pointWords,
                                           (point) => { location.hash = variantOf(point).anchor; }) };
});
function drawCharts() {
    for (const { host, shown, chart } of drawn) if (host.clientWidth) chart.update(shown.lines ? lineContent(shown) : errorContent(shown), true);
}
onChange(["light", "time", "filter"], drawCharts);

const filterField = document.querySelector('input[name="filter"]');
const expose = (stops) => set({ exposure: String(Number(state.exposure) + stops) });
const shortcuts = {
    f: flip, s: () => set({ show: "slider" }), e: () => set({ show: "error" }), c: () => next("colors"), l: () => next("light"), z: () => next("zoom"),
    "+": () => expose(1), "=": () => expose(1), "-": () => expose(-1), "/": () => filterField?.focus(),
};
document.addEventListener("keydown", (event) => {
    if (event.target === filterField && event.key === "Escape") {
        set({ filter: "" });
        filterField.blur();
    }
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches('input[type="search"], select')) return;
    const run = shortcuts[event.key.toLowerCase()];
    if (!run) return;
    if (event.key === "/") event.preventDefault();
    run();
});
readAddress();
window.voxray = { state, pixelsOf, indexIn }; // for tests and the browser's console
