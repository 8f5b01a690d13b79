// Which column of a file holds what, and what the sliders give where it has none.

// The text of a number without a decimal mark: a whole number, with a power of ten where it is not whole. 5.06e-6 is 506e-8.
function withoutMark(text) {
    const number = Number(text);
    if (Number.isNaN(number)) return text;
    if (Number.isSafeInteger(number)) return String(number);
    const [mantissa, power] = number.toExponential().split("e");
    const [whole, part = ""] = mantissa.split(".");
    return `${whole}${part}e${Number(power) - part.length}`;
}

// Columns with their values, in words.
const listed = (columns) =>
    columns.map(([column, value]) => `${column} ${Number.isNaN(Number(value)) ? value : written(Number(value))}`).join(", ");

// Whether a heading ends with brackets, which may state a unit.
const hasBrackets = (heading) => /[\])]$/.test(heading.trim());

class Mapping {
    constructor(form, scene) {
        Object.assign(this, { form, scene, headings: [], units: {}, chosen: new Map() });
        this.take = form.querySelector("#take");
        this.take.addEventListener("change", () => {
            this.isAsked = true;
            this.check();
        });
        this.model.addEventListener("change", () => this.show());
    }

    get model() {
        return this.form.querySelector("#model");
    }

    // The headings of a file: each with its text, the column that it names, and its names as the columns whose unit it states.
    open({ headings, units }) {
        Object.assign(this, { headings, units, chosen: new Map(), isAsked: false });
        this.show();
    }

    get offered() {
        const model = this.model.value;
        return OFFERED.filter(([, , , only]) => !only || model === "both" || only === model);
    }

    // The heading that names a column, if there is one.
    own(column) {
        return this.headings.find((heading) => heading.column === column)?.text ?? "";
    }

    // The heading that holds a column, and its name there.
    choiceOf(column) {
        return this.chosen.get(column) ?? { heading: this.own(column), name: column };
    }

    show() {
        const choices = this.offered.map(([column, words, mark]) => this.choice(column, words, mark));
        this.form.querySelector("#columns div").replaceChildren(...choices);
        this.check();
    }

    // The choice of the heading that holds a column, and of its unit; a heading that names the column has its unit.
    choice(column, words, mark) {
        const own = this.own(column), chosen = this.choiceOf(column);
        const heading = element("select", { id: `column-${column}` }, element("option", { value: "" }, "– none –"));
        for (const { text } of this.headings) heading.append(element("option", { value: text }, text || "(without a name)"));
        heading.value = chosen.heading;
        const units = this.units[column] ?? [];
        const unit = element("select", { id: `unit-${column}`, ariaLabel: `Unit of ${words}` });
        unit.append(element("option", { value: "" }, "unit?"), ...units.map(([name, symbol]) => element("option", { value: name }, symbol)));
        unit.value = chosen.name;
        const show = () => unit.hidden = units.length < 2 || heading.value === "" || heading.value === own;
        const choose = () => {
            this.chosen.set(column, { heading: heading.value, name: unit.value });
            show();
            this.check();
        };
        heading.addEventListener("change", () => {
            // Brackets that state none of its units leave it open.
            const stated = this.headings.find(({ text }) => text === heading.value)?.stated[column];
            unit.value = stated ?? (units.length > 1 && hasBrackets(heading.value) ? "" : column);
            choose();
        });
        unit.addEventListener("change", choose);
        show();
        const label = element("label", { htmlFor: heading.id }, `${words} `, ...symbol(mark));
        return element("div", { className: "choice" }, label, element("span", { className: "pair" }, heading, unit));
    }

    // Why the choices cannot be used; empty if they can.
    problem() {
        const users = new Map();
        for (const [column, words] of this.offered) {
            const { heading, name } = this.choiceOf(column);
            if (heading === "") continue;
            if (name === "") return `“${heading}” is chosen for ${words}, but its unit is not known: choose one beside it.`;
            if (users.has(heading)) {
                return `“${heading}” is chosen for ${users.get(heading)} and for ${words}: choose another column, or none, for one of them.`;
            }
            users.set(heading, words);
        }
        return "";
    }

    // The headings that get another text, by turns with that text; an empty one for a column that is not to be read.
    renamed() {
        const names = new Map();
        for (const [column] of this.offered) {
            const { heading, name } = this.choiceOf(column), own = this.own(column);
            if (heading !== "" && heading !== own) names.set(heading, name);
        }
        for (const [column] of this.offered) {
            const own = this.own(column);
            if (own !== "" && this.choiceOf(column).heading === "" && !names.has(own)) names.set(own, "");
        }
        return [...names].flat();
    }

    // The columns that the table has, as it is read.
    has() {
        const offered = this.offered.map(([column]) => column), taken = this.offered.map(([column]) => this.choiceOf(column).heading);
        const others = this.headings.filter(({ text, column }) => column && !offered.includes(column) && !taken.includes(text));
        const chosen = offered.filter((column) => this.choiceOf(column).heading !== "");
        return new Set([...chosen, ...others.map(({ column }) => column)]);
    }

    // What the sliders give that the table lacks, by column; and whether a row cannot be computed without it.
    lacking() {
        const model = this.model.value, models = model === "both" ? ["rigid-body", "simulation"] : [model];
        const given = Object.assign({}, ...models.map((model) => this.scene.columns(model)));
        const has = this.has();
        const lacked = GROUPS.filter(({ columns }) => !columns.some((column) => has.has(column)));
        const columns = lacked.flatMap(({ columns }) => columns).filter((column) => given[column] !== undefined);
        // Particles and their speeds are what a table is about: without them its columns were hardly recognised.
        const isNeeded = !lacked.some(({ measured }) => measured) && lacked.some(({ needed }) => needed.some((model) => models.includes(model)));
        return { columns: [...new Set(columns)].map((column) => [column, given[column]]), isNeeded };
    }

    // The columns that are taken from the sliders, each with its value in all rows.
    taken() {
        return this.take.checked ? this.lacking().columns : [];
    }

    // Shows what is wrong with the choices, and what the sliders would give.
    check() {
        const problem = this.problem(), { columns, isNeeded } = this.lacking();
        this.form.querySelector("#problem").textContent = problem;
        this.form.querySelector("button").disabled = problem !== "";
        this.form.querySelector("#lacks").hidden = columns.length === 0;
        if (!this.isAsked) this.take.checked = isNeeded;
        this.form.querySelector("#taken").textContent = listed(columns);
    }
}
