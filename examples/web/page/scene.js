// The sliders, and the table of one row that they make.

// Steps of a slider from end to end, and digits of the number that it sets.
const STEPS = 400, DIGITS = 3;

const isLogarithmic = (input) => input.least > 0;

// The value at a position of a slider, and the position of a value.
const valueAt = (input, step) => {
    const part = step / STEPS, { least, most } = input;
    const value = isLogarithmic(input) ? least * (most / least) ** part : least + (most - least) * part;
    return Number(value.toPrecision(DIGITS));
};
const stepOf = (input, value) => {
    const { least, most } = input;
    const part = isLogarithmic(input) ? Math.log(value / least) / Math.log(most / least) : (value - least) / (most - least);
    return Math.min(Math.max(Math.round(STEPS * part), 0), STEPS) || 0;
};

// Choices of materials: of the sphere, and of the surface.
const MATERIALS = ["sphere_material", "surface_material"];

// The text of a number in an SI unit, without the digits that the change of units adds.
const inSi = (number) => String(Number(number.toPrecision(12)));
const DEGREE = Math.PI / 180;

// The label of a box by itself.
const labelOf = (input) => ERRORS.includes(input) ? `Standard error ${input.label}` : input.label;

// What gives the approach speed where the speed along the path is set.
const ALONG_PATH = MOTION.filter(({ key }) => key?.startsWith("path_"));

const keyOf = (input) => input.key ?? input.column;
const element = (name, properties = {}, ...children) => {
    const made = Object.assign(document.createElement(name), properties);
    made.append(...children);
    return made;
};

// A symbol as HTML: what follows an underscore is a subscript.
function symbol(text = "") {
    const [main, index] = text.split("_");
    return index ? [element("i", {}, main), element("sub", {}, index)] : [element("i", {}, main)];
}

class Scene {
    constructor(form, changed) {
        this.values = Object.fromEntries(INPUTS.map((input) => [keyOf(input), input.start]));
        this.rows = new Map();
        const places = { "scene-model": MODEL, particle: PARTICLE, surface: SURFACE, motion: MOTION, along: ALONG, more: MORE, errors: ERRORS };
        for (const [id, inputs] of Object.entries(places)) {
            for (const input of inputs) {
                const { row, show } = input.choices ? this.choice(input) : this.number(input);
                this.rows.set(input, { row, show });
                document.getElementById(id).append(row);
            }
        }
        this.note = element("p", { className: "assumed", hidden: true });
        this.unknown = [];
        document.getElementById("surface").append(this.note);
        this.changed = () => {
            this.showTerms();
            changed();
        };
        form.addEventListener("submit", (event) => event.preventDefault());
        form.addEventListener("reset", (event) => {
            event.preventDefault();
            for (const input of INPUTS) this.values[keyOf(input)] = input.start;
            for (const { show } of this.rows.values()) show();
            this.noteMaterials();
            this.changed();
        });
        this.showTerms();
        this.offerMaterials();
    }

    // Fills the lists of materials.
    async offerMaterials() {
        const { output } = await program.run(["materials", "--format", "json"], "");
        const names = JSON.parse(await output.text()).map(({ name }) => name);
        for (const key of MATERIALS) {
            document.getElementById(key).append(...names.map((name) => element("option", { value: name }, name)));
        }
    }

    // Sets what the chosen materials give: the density of the sphere and, of two materials, the stiffness and the work of adhesion.
    // A number of a pair that the list does not have goes back to where it starts, so that it is not that of another pair.
    async useMaterials() {
        const [sphere, surface] = MATERIALS.map((key) => this.values[key]), pair = [sphere, surface].filter(Boolean);
        this.unknown = [];
        // A surface alone gives nothing: its numbers are those of a pair.
        const [names, numbers] = sphere === "" ? [[], []] : cells(await (await program.run(["materials", ...pair, "--format", "csv"], "")).output.text());
        for (const input of INPUTS.filter(({ of }) => MATERIALS.includes(of) && this.values[of] !== "")) {
            const number = numbers[names.indexOf(input.column)];
            if (!number) this.unknown.push(input);
            this.values[keyOf(input)] = number ? Number((Number(number) / input.si).toPrecision(12)) : input.start;
            this.rows.get(input).show();
        }
        this.noteMaterials();
        this.changed();
    }

    // Says which numbers of this scene are not those of the chosen materials.
    noteMaterials() {
        const [sphere, surface] = MATERIALS.map((key) => this.values[key]), notes = [];
        const unknown = this.unknown.filter((input) => this.has(input) && this.values[input.of] !== "");
        const now = unknown.map((input) => `${input.label.toLowerCase()}, which is now ${input.start} ${input.unit}`).join("; ");
        if (sphere === "" && now !== "") {
            notes.push(`Two materials together give ${now}: choose the material of the sphere too.`);
        } else if (now !== "") {
            notes.push(`The list does not give for ${sphere} on ${surface}: ${now}.`);
        }
        if (sphere !== "" && surface !== "") {
            const others = INPUTS.filter((input) => SURFACE.includes(input) && !input.choices && !input.of && this.has(input));
            notes.push(`No list gives for two materials: ${others.map(({ label }) => label.toLowerCase()).join(", ")}. Enter what you measured.`);
        }
        this.note.textContent = notes.join(" ");
        this.note.hidden = notes.length === 0;
    }

    // A number that is set by hand is no longer that of a material.
    setByHand(input, value) {
        this.values[keyOf(input)] = value;
        if (!input.of) return;
        // Without a material of the sphere there is no pair.
        for (const key of input.of === MATERIALS[0] ? MATERIALS : [input.of]) {
            this.values[key] = "";
            document.getElementById(key).value = "";
        }
        this.noteMaterials();
    }

    choice(input) {
        const key = keyOf(input);
        const select = element("select", { id: key });
        for (const [value, text] of Object.entries(input.choices)) select.append(element("option", { value }, text));
        const show = () => select.value = this.values[key];
        select.addEventListener("change", () => {
            this.values[key] = select.value;
            if (MATERIALS.includes(key)) return this.useMaterials();
            this.noteMaterials();
            this.changed();
        });
        show();
        return { row: element("div", { className: "choice" }, element("label", { htmlFor: key }, input.label), select), show };
    }

    number(input) {
        const key = keyOf(input), name = `${input.label}, ${input.symbol.replace("_", " ")}, ${input.unit}`;
        const range = element("input", { type: "range", min: 0, max: STEPS, ariaLabel: `${name}, slider` });
        const field = element("input", { type: "number", step: "any", id: key, ariaLabel: name, inputMode: "decimal" });
        const show = () => {
            const value = this.values[key];
            range.value = stepOf(input, value);
            range.ariaValueText = `${value} ${input.unit}`;
            field.value = value;
        };
        range.addEventListener("input", () => {
            this.setByHand(input, valueAt(input, Number(range.value)));
            show();
            this.changed();
        });
        field.addEventListener("input", () => {
            // An empty box is no number; the answer says so.
            this.setByHand(input, field.value === "" ? NaN : Number(field.value));
            range.value = stepOf(input, this.values[key]);
            range.ariaValueText = `${field.value} ${input.unit}`;
            this.changed();
        });
        show();
        const label = element("label", { htmlFor: key }, `${input.label} `, ...symbol(input.symbol));
        const unit = element("span", { className: "unit" }, input.unit === "1" ? "" : input.unit);
        return { row: element("div", { className: "number" }, label, range, field, unit), show };
    }

    // Whether the scene has a term, by the model of the sliders or by another.
    has({ where = {} }, model = this.values.scene_model) {
        const value = (choice) => choice === "scene_model" ? model : this.values[choice];
        return Object.entries(where).every(([choice, values]) => values.includes(value(choice)));
    }

    showTerms() {
        for (const [input, { row }] of this.rows) row.hidden = !this.has(input);
        // A fold without a term is none.
        for (const fold of document.querySelectorAll("#scene details")) {
            fold.hidden = [...fold.children].slice(1).every((row) => row.hidden);
        }
    }

    // The boxes of this scene without a number, by their labels.
    empty(model = this.values.scene_model) {
        const isEmpty = (input) => Number.isNaN(this.values[keyOf(input)]) && this.has(input, model);
        return INPUTS.filter(isEmpty).map(labelOf);
    }

    // Why the program refuses a number: with the label of the box instead of the column, and in the unit of the box.
    inItsUnit(reason) {
        const boxOf = (column) => INPUTS.find((input) => input.column === column && !input.choices && this.has(input));
        const [, column, rest] = reason.match(/^(\w+): "[^"]*" is refused: (.*)/) ?? [];
        const input = boxOf(column);
        if (input === undefined) {
            const [, columns, words] = reason.match(/^(\w+(?:, \w+)*): (.*)/) ?? [];
            const boxes = columns?.split(", ").map(boxOf) ?? [];
            if (column === "speed_normal_m_s") return `${ALONG_PATH.map(labelOf).join(", ")}: the ${rest.replace(/;.*/, "")}`;
            if (boxes.length === 0 || boxes.includes(undefined)) return reason;
            return `${boxes.map(labelOf).join(", ")}: ${ERRORS.includes(boxes[0]) ? "it must not be negative" : words}`;
        }
        const unit = input.unit === "1" ? "" : ` ${input.unit}`, { si = 1 } = input;
        const inBox = (number) => digits(Number(number) / si);
        const range = rest.replace(/must be (\S+) to ([^\s;]+).*/, (_, least, most) => `must be ${inBox(least)} to ${inBox(most)}${unit}`);
        return `${labelOf(input)}: ${this.values[keyOf(input)]}${unit} is refused: ${si === 1 ? rest : range}`;
    }

    // What the user asks for, by columns of the program, in SI units; a standard error of zero has no column.
    columns(model = this.values.scene_model) {
        const columns = {};
        if (this.values.arrival === "path") {
            const { path_speed: speed, path_angle: angle } = this.values;
            columns.speed_normal_m_s = inSi(speed * Math.cos(angle * DEGREE));
            columns.speed_tangential_m_s = inSi(speed * Math.sin(angle * DEGREE));
        }
        for (const input of INPUTS.filter((input) => !input.aside && this.has(input, model))) {
            const value = this.values[keyOf(input)];
            if (Number.isNaN(value)) continue;
            if (input.optional && value === input.start) continue;
            if (input.choices) columns[input.column] = value;
            else if (!input.errorOf) columns[input.column] = inSi(value * input.si);
            else if (value !== 0) columns[input.column] = String(Math.abs(Number(columns[input.errorOf])) * value / 100);
        }
        // Hysteretic damping is given by its number alone.
        if (columns.damping === "hysteretic") delete columns.damping;
        return columns;
    }
}

// A table of the program: a row for each of some approach speeds, or one row.
function table(columns, speeds = [columns.speed_normal_m_s]) {
    const names = Object.keys(columns);
    const row = (speed) => names.map((name) => name === "speed_normal_m_s" ? speed : columns[name]).join(",");
    return [names.join(","), ...speeds.map(row), ""].join("\n");
}
