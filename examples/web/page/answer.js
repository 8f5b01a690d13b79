// The answer to the scene of the sliders: its class, charts and numbers.

// Rows of the curve of restitution, and the least distance from the critical speed, relative to it, from which they are spaced.
const CURVE_ROWS = 120, CURVE_START = 1e-5;
// How far the curve goes beyond the speeds of interest, as a factor; and where there is no critical speed.
const BELOW = 0.5, ABOVE = 8, AROUND = 30;

// The tolerance of the course in time: a small one has more samples, and the line through them is smooth.
const COURSE_TOLERANCE = "1e-13";

const CLASSES = ["rebound, sliding", "rebound, rolling", "captured, sliding", "captured, rolling"];

// A number with three digits, in units with a prefix: 1.45 µm.
const PREFIXES = [[1e-15, "f"], [1e-12, "p"], [1e-9, "n"], [1e-6, "µ"], [1e-3, "m"], [1, ""], [1e3, "k"], [1e6, "M"]];
const prefix = (size) => PREFIXES.findLast(([factor]) => size >= factor * 0.9999) ?? PREFIXES[0];
const digits = (number) => written(Number(Number(number).toPrecision(3)));
function inUnits(number, unit) {
    if (number === "" || number === undefined) return "–";
    const value = Number(number);
    const [factor, name] = value === 0 ? [1, ""] : prefix(Math.abs(value));
    return `${digits(value / factor)} ${name}${unit}`;
}

// The approach speeds of the curve: dense above the critical speed, where restitution begins as a square root.
function curveSpeeds(speed, critical) {
    const geometric = (from, to) => Array.from({ length: CURVE_ROWS }, (_, k) => from * (to / from) ** (k / (CURVE_ROWS - 1)));
    if (critical === undefined) return geometric(speed / AROUND, speed * AROUND);
    const [low, high] = [BELOW * Math.min(speed, critical), ABOVE * Math.max(speed, critical)];
    return [low, critical, ...geometric(CURVE_START, high / critical - 1).map((part) => critical * (1 + part))];
}

// The critical speed of a rigid body, from its row.
function criticalOf({ speed_normal_m_s: speed }, { speed_over_critical: over, outcome }) {
    if (over) return { critical: "speed", critical_speed_m_s: speed / over };
    return { critical: outcome === "rebound" ? "always rebounds" : "never rebounds" };
}

class Answer {
    constructor(scene) {
        Object.assign(this, { scene, pending: false, computing: false, section: document.getElementById("answer") });
    }

    // Computes the answer to the scene as it is; while one is computed, only the last of further changes counts.
    async update() {
        this.pending = true;
        if (this.computing) return;
        this.computing = true;
        this.section.ariaBusy = "true";
        while (this.pending) {
            this.pending = false;
            try {
                const empty = this.scene.empty();
                if (empty.length > 0) throw new Error(`Enter a number in each box. Empty: ${empty.join(", ")}.`);
                this.show(await this.compute(this.scene.columns(), this.scene.values.scene_model));
            } catch (error) {
                this.refuse(this.scene.inItsUnit(error.message));
            }
        }
        this.computing = false;
        this.section.ariaBusy = "false";
    }

    async compute(columns, model) {
        const classify = ["classify", "--model", model];
        const exact = Object.fromEntries(Object.entries(columns).filter(([name]) => !/_error(_|$)/.test(name)));
        const [row] = await program.rows(classify, table(columns));
        if (row.error) throw new Error(row.error);
        const simulated = model === "simulation";
        const found = simulated ? (await program.rows(["critical"], table(exact)))[0] : criticalOf(columns, row);
        const critical = found.critical === "speed" ? Number(found.critical_speed_m_s) : undefined;
        const speeds = curveSpeeds(Number(columns.speed_normal_m_s), critical);
        const curve = await program.rows(classify, table(exact, speeds));
        // A rigid body has no course in time.
        const course = simulated ? await program.rows(["trajectory", "--tolerance", COURSE_TOLERANCE], table(exact)) : [];
        return { columns, row, found, critical, curve, course, simulated };
    }

    // Says why there is no answer, and shows no number or chart of another.
    refuse(reason) {
        this.section.className = "refused";
        document.getElementById("class").textContent = "No answer";
        document.getElementById("margin").textContent = reason;
        document.getElementById("results").hidden = true;
        for (const part of document.querySelectorAll("#results figure, #numbers tbody")) part.replaceChildren();
    }

    show(answer) {
        const { row } = answer;
        const outcome = row.outcome === "capture" ? "captured" : row.outcome;
        this.section.className = outcome;
        const title = [outcome, row.motion].filter(Boolean).join(", ");
        document.getElementById("class").textContent = title[0].toUpperCase() + title.slice(1);
        document.getElementById("margin").replaceChildren(...margin(answer));
        document.getElementById("results").hidden = false;
        document.getElementById("course").hidden = !answer.simulated;
        showNumbers(answer);
        showCurve(answer);
        if (answer.simulated) showCourse(answer);
    }
}

// How certain the class is: the distance from the critical speed and, with standard errors, the probability of each class.
function margin({ columns, row, found, critical }) {
    const speed = Number(columns.speed_normal_m_s);
    const parts = [
        critical !== undefined
            ? `The approach speed is ${digits(speed / critical)} times the critical speed, ${inUnits(critical, "m/s")}.`
            : `There is no critical speed: the sphere ${found.critical} from 10⁻¹² to 10⁶ m/s.`,
    ];
    if (row.probability_error !== undefined) {
        const named = CLASSES.map((name) => [name, row[`probability_${name.replace(", ", "_")}`]]);
        const most = named.filter(([, value]) => Number(value) >= 0.0005).sort(([, a], [, b]) => b - a);
        const list = most.map(([name, value]) => `${name} ${Number(value).toFixed(3)}`).join("; ");
        parts.push(element("br"), `Probability: ${list}; each within ${digits(row.probability_error)}.`);
    }
    return parts;
}

function showNumbers({ columns, row, critical, simulated }) {
    const e = row.overall_restitution, rebounds = row.outcome === "rebound";
    const slip = row.time_roll_s === "-1" ? "to the end" : row.time_roll_s === "0" ? "no slip" : inUnits(row.time_roll_s, "s");
    // The simulation follows a captured sphere so far.
    const until = simulated && row.outcome === "capture" ? " until it first turns back" : "";
    const simulation = [
        ["Largest indentation", "δ", inUnits(row.max_indentation_m, "m")],
        ["Contact time", "t", inUnits(row.contact_time_s, "s")],
        row.phases ? ["Phases of stick and slip", "", row.phases] : ["Slips for", "", slip],
        ...(row.speed_over_yield ? [["Approach speed over that of yield", "", digits(row.speed_over_yield)]] : []),
    ];
    const rigidBody = [
        ["Impulse ratio", "μ", digits(row.impulse_ratio_out)],
        ["Energy lost to friction", "", inUnits(row.work_friction_j, "J")],
    ];
    const numbers = [
        ["Restitution", "e", e === "" ? "–" : digits(e)],
        ["Rebound speed", "V_n", rebounds ? inUnits(e * columns.speed_normal_m_s, "m/s") : "–"],
        ["Tangential velocity after", "V_t", inUnits(row.speed_tangential_out_m_s, "m/s")],
        ["Spin after", "Ω", inUnits(row.spin_out_rad_s, "rad/s")],
        ["Critical speed", "v_c", inUnits(critical, "m/s")],
        ...(simulated ? simulation : rigidBody),
        [`Energy lost in the materials${until}`, "", inUnits(row.work_material_j, "J")],
        [`Energy lost to adhesion${until}`, "", inUnits(row.work_adhesion_j, "J")],
    ];
    const rows = numbers.map(([label, name, value]) =>
        element("tr", {}, element("th", { scope: "row" }, `${label} `, ...symbol(name)), element("td", {}, value)));
    document.querySelector("#numbers tbody").replaceChildren(...rows);
}

function showCurve({ columns, row, critical, curve }) {
    const speed = Number(columns.speed_normal_m_s);
    const known = curve.filter((row) => row.overall_restitution !== "");
    const points = known.map((row) => [Number(row.speed_normal_m_s), Number(row.overall_restitution)]);
    const largest = Math.max(0, ...points.map(([, e]) => e)) || 1;
    const speeds = curve.map((row) => Number(row.speed_normal_m_s));
    const e = Number(row.overall_restitution);
    const at = critical === undefined ? "there is no critical speed" : `the critical speed is ${inUnits(critical, "m/s")}`;
    chart(document.getElementById("restitution-curve"), {
        x: { label: "approach speed, m/s", range: [speeds[0], speeds.at(-1)], logarithmic: true },
        y: { label: "restitution e", range: [0, Math.min(Math.ceil(largest * 1.1 * 5) / 5, 1)] },
        lines: [{ points }],
        shade: critical === undefined ? undefined : { x: critical, text: "captured" },
        marks: critical === undefined ? [] : [{ x: critical, text: `critical speed ${inUnits(critical, "m/s")}` }],
        dots: row.outcome === "undecided" ? [] : [[speed, e]],
        summary: `Restitution against approach speed: ${at}; at ${inUnits(speed, "m/s")} the restitution is ${digits(e)}.`,
    });
}

// Points of a course against time, with an axis in units that fit them.
function axisOf(values, name, unit) {
    const [least, most] = [Math.min(...values), Math.max(...values)];
    const [factor, short] = prefix(Math.max(Math.abs(least), Math.abs(most)));
    const room = 0.06 * (most - least || factor) / factor;
    return { factor, axis: { label: `${name}, ${short}${unit}`, range: [least < 0 ? least / factor - room : 0, most / factor + room] }, most };
}

function showCourse({ course }) {
    const times = course.map((sample) => Number(sample.time_s));
    const [unit, short] = prefix(times.at(-1));
    for (const [id, column, name, si] of [["force", "force_n", "force", "N"], ["indentation", "indentation_m", "indentation", "m"]]) {
        const values = course.map((sample) => Number(sample[column]));
        const { factor, axis, most } = axisOf(values, name, si);
        chart(document.getElementById(id), {
            x: { label: `time from first contact, ${short}s`, range: [0, times.at(-1) / unit] },
            y: axis,
            lines: [{ points: times.map((time, k) => [time / unit, values[k] / factor]) }],
            summary: `${name[0].toUpperCase()}${name.slice(1)} against time, at most ${inUnits(most, si)}, for ${inUnits(times.at(-1), "s")}.`,
            height: 210,
        });
    }
}

const scene = new Scene(document.getElementById("scene"), () => {
    answer.update();
    // What the table takes from the sliders.
    impacts.mapping.check();
});
const answer = new Answer(scene);
answer.update();
let resized;
window.addEventListener("resize", () => {
    clearTimeout(resized);
    resized = setTimeout(() => answer.update(), 150);
});
