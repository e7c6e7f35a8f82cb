// A chart of numbers on logarithmic or linear axes: lines and marks with names next to them, all else faint.

const reachOfPointer = 40; // pixels
const fontSize = 11, reachOfLabels = 132; // pixels
let chartCount = 0;

// What is drawn: {series: [{color, mark, isBold, isFaint, points, line, marks}], labels: [{text, color, point, isBold}],
// front: [[x, y]], levels: [[name, y]], paths: [[point]], xLabel, yLabel, text, isLinear, hasBars}. A point is {index, x, y, low,
// high, xLow, xHigh, isFaint}; line: those that a series joins; marks: those with a mark, its line's where it says nothing;
// paths: along which arrow keys go.
// label: what a screen reader says; tell(point): words of the point under the pointer or the keyboard's; open(point) is called for a
// click on it or Enter.
function makeChart(host, label, tell, open = () => {}) {
    const id = `chart-${chartCount++}`, said = element("output", { class: "said", "aria-live": "polite" });
    for (const [name, value] of Object.entries({ tabindex: 0, role: "group", "aria-roledescription": "chart", "aria-label": label })) {
        host.setAttribute(name, value);
    }
    host.after(said);
    let content = null, zoom = null, current = null, size, x, y, nearest;
    addEventListener("resize", () => { if (content && host.clientWidth) draw(); });
    host.addEventListener("pointermove", (event) => { if (event.pointerType !== "mouse" || !event.buttons) point(event); });
    host.addEventListener("pointerdown", (event) => point(event));
    host.addEventListener("click", (event) => { if (point(event, 12)) open(current); });
    host.addEventListener("dblclick", () => setZoom(null));
    host.addEventListener("keydown", onKey);
    host.addEventListener("focus", () => {
        const first = content?.paths.find((path) => path.length);
        if (!current && first) select(first[0]);
    });

    function point(event, reach = reachOfPointer) {
        const box = host.firstElementChild.getBoundingClientRect(), scale = size.width / box.width;
        const found = nearest.find((event.clientX - box.left) * scale, (event.clientY - box.top) * scale, reach);
        if (found && found !== current) select(found);
        return found;
    }
    function select(found) {
        current = found;
        mark();
        said.textContent = tell(found);
    }
    function setZoom(domain) {
        zoom = domain;
        draw();
    }
    // Left and right go along a path, up and down to the next one
    function onKey(event) {
        const paths = content.paths.filter((path) => path.length);
        const p = paths.findIndex((path) => path.includes(current)), path = paths[Math.max(0, p)] ?? [], i = path.indexOf(current);
        const beside = (step) => paths[p < 0 ? 0 : (p + step + paths.length) % paths.length]?.[0];
        const to = { ArrowLeft: path[Math.max(0, i - 1)], ArrowRight: path[Math.min(path.length - 1, i + 1)], Home: path[0],
                     End: path[path.length - 1], ArrowUp: beside(-1), ArrowDown: beside(1) }[event.key];
        if (to) select(to);
        else if (event.key === "Escape") setZoom(null);
        else if (event.key === "Enter" && current) open(current);
        else if (event.key === "+" && current) setZoom([around(x, current.x), around(y, current.y)]);
        else return;
        event.preventDefault();
        event.stopPropagation();
    }
    // Half of an axis round a value
    const around = (axis, value) => {
        const [a, b] = axis.range(), half = Math.abs(b - a) / 4, middle = axis(value), order = Math.sign(b - a);
        return [axis.invert(middle - order * half), axis.invert(middle + order * half)];
    };

    function ticksOf(axis) {
        if (content.isLinear) return axis.ticks(6);
        const [low, high] = d3.extent(axis.domain());
        const steps = Math.log10(high / low) > 2.2 ? [1] : Math.log10(high / low) > 0.6 ? [1, 2, 5] : [1, 1.5, 2, 3, 4, 5, 6, 8];
        return d3.range(Math.floor(Math.log10(low)), Math.ceil(Math.log10(high)) + 1)
            .flatMap((decade) => steps.map((step) => Number(`${step}e${decade}`))).filter((tick) => tick >= low && tick <= high);
    }
    function domainOf(values, fromZero) {
        const [low, high] = d3.extent(values);
        if (content.isLinear) return [fromZero ? Math.min(0, low) : low, high + 0.04 * (high - low || 1)];
        const margin = Math.max((high / low) ** 0.04, 2 / Math.sqrt(high / low));
        return low > 0 ? [low / margin, high * margin] : [1, 10];
    }

    function draw() {
        const points = content.series.flatMap((one) => one.points);
        const width = Math.max(280, host.clientWidth), height = Math.round(Math.min(430, Math.max(300, 0.62 * width)));
        const margin = { left: 58, right: Math.min(0.2 * width, 20 + 0.56 * fontSize * (d3.max(content.labels, ({ text }) => text.length) ?? 0)), top: 22, bottom: 44 };
        size = { width, height, margin };
        const scale = content.isLinear ? d3.scaleLinear : d3.scaleLog;
        const heights = points.flatMap((p) => (content.hasBars && p.high > 0 ? [p.y, p.high] : [p.y])).concat((content.levels ?? []).map(([, value]) => value));
        x = scale(zoom ? zoom[0] : domainOf(points.map((p) => p.x)), [margin.left, width - margin.right]);
        y = scale(zoom ? zoom[1] : domainOf(heights, true), [height - margin.bottom, margin.top]);
        const svg = d3.create("svg").attr("class", "chart").attr("viewBox", `0 0 ${width} ${height}`).attr("role", "img").attr("aria-label", content.text);
        svg.append("clipPath").attr("id", id).append("rect").attr("x", margin.left).attr("y", margin.top)
            .attr("width", width - margin.left - margin.right).attr("height", height - margin.top - margin.bottom);
        drawAxes(svg);
        const brush = d3.brush().extent([[margin.left, margin.top], [width - margin.right, height - margin.bottom]]).touchable(false);
        const area = svg.append("g").attr("class", "brush").call(brush);
        brush.on("end", () => {
            const box = d3.brushSelection(area.node());
            if (box) setZoom([[x.invert(box[0][0]), x.invert(box[1][0])], [y.invert(box[1][1]), y.invert(box[0][1])]]);
        });
        const inside = svg.append("g").attr("clip-path", `url(#${id})`).attr("pointer-events", "none");
        drawPoints(inside);
        const labels = svg.append("g").attr("pointer-events", "none");
        svg.append("g").attr("class", "current").attr("clip-path", `url(#${id})`).attr("pointer-events", "none");
        host.replaceChildren(svg.node());
        drawLabels(labels); // their lengths are known in the page alone
        nearest = d3.quadtree(points.filter(isInside), (p) => x(p.x), (p) => y(p.y));
        host.dataset.zoomed = zoom ? "true" : "";
        mark();
    }
    const isInside = (p) => x(p.x) >= size.margin.left - 1 && x(p.x) <= size.width - size.margin.right + 1
        && y(p.y) >= size.margin.top - 1 && y(p.y) <= size.height - size.margin.bottom + 1;

    function drawAxes(svg) {
        const { width, height, margin } = size;
        const bottom = svg.append("g").attr("class", "axis").attr("transform", `translate(0,${height - margin.bottom})`)
            .call(d3.axisBottom(x).tickValues(ticksOf(x)).tickFormat((v) => figures(v)).tickSize(margin.top + margin.bottom - height).tickPadding(6));
        const left = svg.append("g").attr("class", "axis").attr("transform", `translate(${margin.left},0)`)
            .call(d3.axisLeft(y).tickValues(ticksOf(y)).tickFormat((v) => figures(v)).tickSize(margin.left + margin.right - width).tickPadding(6));
        for (const axis of [bottom, left]) axis.selectAll(".domain").remove();
        svg.append("text").attr("class", "title").attr("x", (margin.left + width - margin.right) / 2).attr("y", height - 8)
            .attr("text-anchor", "middle").text(content.isLinear ? content.xLabel : `${content.xLabel} (← cheaper)`);
        svg.append("text").attr("class", "title").attr("x", 6).attr("y", 13).text(content.isLinear ? content.yLabel : `${content.yLabel} (↓ more accurate)`);
    }

    function drawPoints(inside) {
        const position = (p) => `${x(p.x).toFixed(1)},${y(p.y).toFixed(1)}`, bottom = size.height - size.margin.bottom;
        for (const [, value] of content.levels ?? []) {
            inside.append("path").attr("class", "level").attr("d", `M${size.margin.left},${y(value)}H${size.width - size.margin.right}`);
        }
        if (content.front.length) {
            inside.append("path").attr("class", "front").attr("d", d3.line().x(([px]) => x(px)).y(([, py]) => y(py)).curve(d3.curveStepAfter)(content.front));
        }
        for (const one of content.series) {
            const group = inside.append("g").attr("class", "series" + (one.isBold ? " bold" : "") + (one.isFaint ? " faint" : ""))
                .attr("stroke", `var(--${one.color})`).attr("fill", `var(--${one.color})`);
            const marks = one.marks ?? one.line, isMarked = new Set(marks);
            // Strokes of no length with round ends: one path for thousands of points
            group.append("path").attr("class", "dots").attr("fill", "none").attr("d", one.points.filter((p) => !isMarked.has(p)).map((p) => `M${position(p)}h0`).join(""));
            group.append("path").attr("class", "curve").attr("fill", "none").attr("d", one.line.length ? `M${one.line.map(position).join("L")}` : "");
            if (content.hasBars) {
                group.append("path").attr("class", "spans").attr("d", marks.filter((p) => !p.isFaint).map((p) =>
                    `M${x(p.xLow)},${y(p.y)}H${x(p.xHigh)}M${x(p.x)},${p.low > 0 ? y(p.low) : bottom}V${y(p.high)}`).join(""));
            }
            for (const p of marks) {
                group.append("path").attr("class", p.isFaint ? "mark faint" : "mark").attr("d", one.mark)
                    .attr("transform", `translate(${position(p)}) scale(${one.isBold || content.hasBars ? 1 : 0.75})`);
            }
        }
    }

    // Names next to their points: off other names, over as few marks, lines and leaders as can be, nearest first
    function drawLabels(group) {
        const { width, height, margin } = size, taken = [], ink = [], at = (p) => [x(p.x), y(p.y)];
        const trace = ([px, py], [qx, qy]) => {
            const count = Math.ceil(Math.hypot(qx - px, qy - py) / 6) || 1;
            for (let k = 0; k <= count; k++) ink.push([px + (qx - px) * k / count, py + (qy - py) * k / count]);
        };
        const holds = (box, [px, py]) => px > box.left && px < box.right && py > box.top && py < box.bottom;
        const overlap = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
        const isFree = (box) => box.left >= margin.left - 4 && box.right <= width && box.top >= 0
            && box.bottom <= height - margin.bottom && !taken.some((other) => overlap(box, other));
        function place([px, py], text, css, color) {
            const name = group.append("text").attr("class", css).attr("font-size", fontSize).attr("fill", color).text(text);
            const length = name.node().getComputedTextLength() + 2;
            const boxes = d3.cross(d3.range(-reachOfLabels, reachOfLabels + 1, 6), [px + 8, px - 8 - length], (offset, left) => {
                const end = [left < px ? left + length : left, py + offset];
                return { left, right: left + length, top: end[1] - 7, bottom: end[1] + 7, offset, end };
            }).filter(isFree);
            const costs = boxes.map((box) => {
                const leader = d3.range(0.1, 1, 0.1).map((part) => [px + part * (box.end[0] - px), py + part * box.offset]);
                return Math.abs(box.offset) + 8 * ink.filter((point) => holds(box, point)).length
                    + 40 * taken.filter((other) => leader.some((point) => holds(other, point))).length;
            });
            const best = boxes[costs.indexOf(d3.min(costs))];
            if (!best) return name.remove();
            taken.push(best);
            name.attr("x", best.left + 1).attr("y", best.end[1] + 4);
            if (Math.abs(best.offset) <= 8) return name;
            group.insert("path", "text").attr("class", "leader").attr("stroke", color).attr("d", `M${[px, py]}L${best.end}`);
            return trace([px, py], best.end);
        }
        for (const { line, marks = line } of content.series) {
            d3.pairs(line.map(at), trace);
            for (const p of marks) {
                ink.push(at(p), at(p), at(p)); // heavier than a piece of a line
                if (content.hasBars) trace([x(p.xLow), y(p.y)], [x(p.xHigh), y(p.y)]);
                if (content.hasBars && p.low > 0) trace([x(p.x), y(p.low)], [x(p.x), y(p.high)]);
            }
        }
        const right = width - margin.right + 6;
        for (const [name, value] of content.levels ?? []) place([right, y(value) - 8], name, "level", "var(--muted)");
        for (const { text, color, point: end, isBold } of content.labels) {
            if (isInside(end) && !end.isFaint) place(at(end), text, isBold ? "name bold" : "name", `var(--${color})`);
        }
    }

    function mark() {
        const group = d3.select(host).select(".current");
        group.selectAll("*").remove();
        if (!current || !isInside(current)) return;
        const [px, py] = [x(current.x), y(current.y)], bottom = size.height - size.margin.bottom;
        const ends = [current.high, current.low].map((value) => (value > 0 ? Math.min(bottom, y(value)) : bottom));
        group.append("path").attr("class", "interval").attr("d", `M${px},${ends[0]}V${ends[1]}M${px - 5},${ends[0]}h10M${px - 5},${ends[1]}h10`);
        group.append("circle").attr("cx", px).attr("cy", py).attr("r", 8);
    }

    return {
        // Draws other numbers; the current point stays where its index is there still.
        update(changed, keepZoom = false) {
            content = changed;
            if (!keepZoom) zoom = null;
            current = current && (content.series.flatMap((one) => one.points).find((p) => p.index === current.index) ?? null);
            draw();
            if (current) said.textContent = tell(current);
        },
        select(index) {
            const found = content.series.flatMap((one) => one.points).find((p) => p.index === index);
            if (found) select(found);
        },
        resetZoom: () => setZoom(null), svg: () => standalone(host.firstElementChild),
    };
}

// A chart as a file of its own, with the colors and strokes that it has on the page.
function standalone(svg) {
    const copy = svg.cloneNode(true), from = svg.querySelectorAll("*"), box = svg.viewBox.baseVal;
    const keys = ["fill", "stroke", "stroke-width", "stroke-linecap", "stroke-dasharray", "opacity", "font-size", "font-weight", "font-family", "text-anchor", "paint-order"];
    copy.querySelectorAll("*").forEach((part, i) => {
        const style = getComputedStyle(from[i]);
        for (const key of keys) part.setAttribute(key, style.getPropertyValue(key));
    });
    for (const part of copy.querySelectorAll(".brush, .current")) part.remove();
    for (const [name, value] of Object.entries({ xmlns: "http://www.w3.org/2000/svg", width: box.width, height: box.height })) copy.setAttribute(name, value);
    return `${new XMLSerializer().serializeToString(copy)}\n`;
}
