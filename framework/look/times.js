// What an image costs.

/** A line on the whole frame. */
export function frameText(answer) {
    const rate = answer.frame_ms > 0 ? `, ${Number((1000 / answer.frame_ms).toPrecision(2))} a second` : "";  // A view may need no pass
    return `${answer.width} × ${answer.height}: frame ${answer.frame_ms.toFixed(1)} ms${rate}, ${(answer.memory_bytes / 2 ** 20).toFixed(1)} MiB`;
}

/** Bars of the passes' times, those of passes that run once apart from the rest. */
export function showTimes(place, costs) {
    const longest = Math.max(...costs.map((pass) => pass.ms), 1e-6);
    place.replaceChildren(...costs.flatMap((pass) => {
        const [name, track, total] = ["span", "span", "span"].map((tag) => document.createElement(tag));
        name.className = "bar-name";
        name.textContent = pass.phase === "build" ? `${pass.id}, once` : pass.id;
        track.className = "bar-track";
        const bar = document.createElement("i");
        bar.style.width = `${100 * pass.ms / longest}%`;
        bar.style.background = pass.phase === "build" ? "var(--c4)" : "var(--c0)";
        track.append(bar);
        total.className = "bar-total";
        total.textContent = `${pass.ms.toFixed(2)} ms, ${(pass.memory_bytes / 2 ** 20).toFixed(1)} MiB${pass.reused ? ", kept" : ""}`;
        return [name, track, total];
    }));
}
