// The page of `voxray tune`: its trials, joined in the order in which they ran.

const trials = data.trials.filter(({ x, y }) => x > 0 && y > 0)
    .map((trial) => ({ ...trial, index: trial.number, low: trial.y, high: trial.y }));
const ofKind = Object.entries(data.styles).map(([kind, own]) => {
    const points = trials.filter((trial) => trial.kind === kind);
    return { ...own, points, marks: points, line: [], isBold: kind === "chosen" };
});
const labels = ofKind.flatMap(({ color, isBold, points }) => points.map((point) => (
    { point, color, isBold, text: isBold ? `${point.number} chosen` : String(point.number) })));
makeChart(byId("trials"), "Chart of the trials: arrow keys go from trial to trial", ({ number, kind, name, x, y }) =>
    `Trial ${number} (${kind}): ${name}: ${figures(x)} ${data.cost}, ${figures(y)} times the target's error`).update({
    series: [{ color: "muted", points: [], marks: [], line: trials }, ...ofKind],
    labels: labels.reverse(), levels: [["target", 1]], front: [], paths: [trials],
    xLabel: data.cost, yLabel: "error over the target's",
    text: `${trials.length} trials by ${data.cost} and error`,
});
