// Charts of lines in SVG.

const SVG = "http://www.w3.org/2000/svg";
const MARGIN = { left: 62, right: 14, top: 12, bottom: 42 };

function draw(parent, name, attributes, text = "") {
    const made = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    made.textContent = text;
    parent.append(made);
    return made;
}

// About `count` round numbers in a range.
function ticks([from, to], count) {
    const raw = (to - from) / count, power = 10 ** Math.floor(Math.log10(raw));
    const step = power * [1, 2, 5, 10].find((factor) => factor * power >= raw);
    const first = Math.ceil(from / step), last = Math.floor(to / step + 1e-9);
    return Array.from({ length: last - first + 1 }, (_, k) => Number(((first + k) * step).toPrecision(12)));
}

// Round numbers of a logarithmic axis: 1, 2 and 5 of each decade, or the decades alone.
function logarithmicTicks([from, to], count) {
    const decades = Math.log10(to / from);
    const factors = decades > count / 3 ? [1] : decades > 0.5 ? [1, 2, 5] : [1, 1.5, 2, 3, 4, 5, 7];
    const first = Math.floor(Math.log10(from));
    const all = Array.from({ length: Math.ceil(decades) + 2 }, (_, k) => factors.map((factor) => factor * 10 ** (first + k)));
    return all.flat().map((tick) => Number(tick.toPrecision(6))).filter((tick) => tick >= from * (1 - 1e-9) && tick <= to * (1 + 1e-9));
}

const written = (number) => {
    const size = Math.abs(number);
    return size !== 0 && (size < 1e-3 || size >= 1e5) ? number.toExponential().replace("e+", "e") : String(number).replace("-", "−");
};

// Draws a chart into a figure. Each axis has a `label`, a `range` and may be `logarithmic`; a line has `points` and may be
// `dashed`; `shade` is a range from the left up to `x`
// with a `text`; a mark is a vertical line with a `text`; a dot is a point. `summary` says in words what the chart shows.
function chart(figure, { x, y, lines = [], marks = [], dots = [], shade, summary, height = 260 }) {
    const width = Math.max(figure.clientWidth, 260);
    const right = width - MARGIN.right, bottom = height - MARGIN.bottom;
    const scale = (axis, from, to) => {
        const map = axis.logarithmic ? Math.log : (value) => value;
        const [low, high] = axis.range.map(map);
        return (value) => from + (to - from) * (map(value) - low) / (high - low);
    };
    const at = { x: scale(x, MARGIN.left, right), y: scale(y, bottom, MARGIN.top) };
    const svg = document.createElementNS(SVG, "svg");
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    svg.setAttribute("role", "img");
    svg.setAttribute("aria-label", summary);
    if (shade) {
        const wide = Math.max(at.x(shade.x) - MARGIN.left, 0);
        draw(svg, "rect", { class: "shade", x: MARGIN.left, y: MARGIN.top, width: wide, height: bottom - MARGIN.top });
        if (wide > 70) draw(svg, "text", { x: MARGIN.left + wide / 2, y: bottom - 10, "text-anchor": "middle" }, shade.text);
    }
    for (const tick of x.logarithmic ? logarithmicTicks(x.range, width / 80) : ticks(x.range, width / 90)) {
        draw(svg, "line", { class: "grid", x1: at.x(tick), x2: at.x(tick), y1: MARGIN.top, y2: bottom });
        draw(svg, "text", { x: at.x(tick), y: bottom + 17, "text-anchor": "middle" }, written(tick));
    }
    for (const tick of ticks(y.range, height / 55)) {
        draw(svg, "line", { class: tick === 0 ? "axis" : "grid", x1: MARGIN.left, x2: right, y1: at.y(tick), y2: at.y(tick) });
        draw(svg, "text", { x: MARGIN.left - 7, y: at.y(tick) + 4, "text-anchor": "end" }, written(tick));
    }
    draw(svg, "rect", { class: "frame", x: MARGIN.left, y: MARGIN.top, width: right - MARGIN.left, height: bottom - MARGIN.top });
    draw(svg, "text", { x: (MARGIN.left + right) / 2, y: height - 6, "text-anchor": "middle" }, x.label);
    const middle = (MARGIN.top + bottom) / 2;
    draw(svg, "text", { x: 14, y: middle, "text-anchor": "middle", transform: `rotate(-90 14 ${middle})` }, y.label);
    for (const { points, dashed } of lines) {
        const path = points.map(([u, v]) => `${at.x(u).toFixed(2)},${at.y(v).toFixed(2)}`).join(" ");
        draw(svg, "polyline", { class: dashed ? "line dashed" : "line", points: path });
    }
    for (const { x: place, text } of marks) {
        const before = at.x(place) > (MARGIN.left + right) / 2;
        draw(svg, "line", { class: "mark", x1: at.x(place), x2: at.x(place), y1: MARGIN.top, y2: bottom });
        draw(svg, "text", { x: at.x(place) + (before ? -6 : 6), y: MARGIN.top + 16, "text-anchor": before ? "end" : "start" }, text);
    }
    for (const [u, v] of dots) draw(svg, "circle", { class: "dot", cx: at.x(u), cy: at.y(v), r: 5 });
    figure.replaceChildren(svg);
}
