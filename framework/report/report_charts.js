"use strict";
// The report's charts: error against time of all variants, and numbers over frames.
(() => {
    const holder = document.getElementById("chart-data");
    if (!holder) return;
    const data = JSON.parse(holder.textContent);
    const drawn = [];

    // What the filter keeps is drawn as it is, the rest faint
    const isFaint = (i) => page.matching !== undefined && !page.matching.has(data.variants[i].number);

    function errorContent(chart) {
        const [value, low, high] = chart.error, [time, fast, slow] = data.times[chart.time], marked = new Set(chart.marked);
        const points = new Map(chart.drawn.map((i) => [i, {
            index: i, x: time[i], xLow: fast[i], xHigh: slow[i], y: value[i], low: low[i], high: high[i], isFaint: isFaint(i) }]));
        const series = d3.nest().key((p) => data.variants[p.index].color + data.variants[p.index].mark).entries([...points.values()]).map(({ values }) => ({
            ...data.variants[values[0].index], points: values, marks: values.filter((p) => marked.has(p.index)), line: [] }));
        for (const curve of data.curves) {
            const line = curve.map((i) => points.get(i)).filter((p) => p).sort((a, b) => a.x - b.x);
            if (line.length) series.unshift({ ...data.variants[curve[0]], points: [], marks: [], line });
        }
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
    function words(point) {
        const variant = data.variants[point.variant ?? point.index];
        const interval = point.low < point.high ? ` (${figures(point.low)} to ${figures(point.high)})` : "";
        return `${variant.name}: ${figures(point.x)}${point.variant === undefined ? " ms" : ""}, ${figures(point.y)}${interval}`;
    }

    for (const host of document.querySelectorAll(".plot")) {
        const shown = data.charts[Number(host.dataset.chart)];
        const said = element("output", { class: "said", "aria-live": "polite" });
        for (const [name, value] of Object.entries({ tabindex: 0, role: "group", "aria-roledescription": "chart", "aria-label": `${shown.text}; arrow keys move, Enter leads to a variant` })) {
            host.setAttribute(name, value);
        }
        host.after(said);
        const open = (point) => { location.hash = data.variants[point.variant ?? point.index].anchor; };
        drawn.push({ host, shown, chart: makeChart(host, (point) => { said.textContent = words(point); }, open) });
    }
    function draw() {
        for (const { host, shown, chart } of drawn) if (host.clientWidth) chart.update(shown.lines ? lineContent(shown) : errorContent(shown), true);
    }
    page.onChange(["light", "time", "filter"], draw);
    addEventListener("resize", draw);
})();
