// A file of impacts: its columns, and the result to save.

// Columns that are shown where they hold something; the file has all.
const SHOWN = ["name", "outcome", "motion", "overall_restitution", "contact_time_s", "models_agree", "class", "probability_capture", "error"];

class TableOfImpacts {
    constructor(section) {
        this.section = section;
        this.form = section.querySelector("form");
        this.outcome = section.querySelector("#outcome");
        const input = section.querySelector("#file");
        input.addEventListener("change", () => input.files[0] && this.open(input.files[0]));
        for (const name of ["dragenter", "dragover"]) {
            document.addEventListener(name, (event) => {
                event.preventDefault();
                section.classList.add("over");
            });
        }
        document.addEventListener("dragleave", (event) => event.relatedTarget ?? section.classList.remove("over"));
        document.addEventListener("drop", (event) => {
            event.preventDefault();
            section.classList.remove("over");
            if (event.dataTransfer.files[0]) this.open(event.dataTransfer.files[0]);
        });
        this.form.addEventListener("submit", (event) => {
            event.preventDefault();
            this.classify();
        });
        section.querySelector("#model").addEventListener("change", () => this.showColumns());
    }

    // Reads the header of a file and offers its columns.
    async open(file) {
        this.file = file;
        this.section.querySelector("#file-name").textContent = file.name;
        this.form.hidden = true;
        await this.attempt(async () => {
            const { status, output, errors } = await program.run(["columns"], file);
            if (status !== 0) throw new Error(await errors.text());
            ({ headings: this.headings, units: this.units } = JSON.parse(await output.text()));
            this.chosen = new Map();
            this.showColumns();
            this.outcome.replaceChildren();
            this.form.hidden = false;
        });
    }

    showColumns() {
        const model = this.section.querySelector("#model").value;
        const offered = OFFERED.filter(([, , , only]) => !only || model === "both" || only === model);
        this.section.querySelector("#columns div").replaceChildren(...offered.map(([column, words, mark]) => this.choice(column, words, mark)));
    }

    // The choice of the heading that holds a column, and of its unit; a heading that names the column has its unit.
    choice(column, words, mark) {
        const own = this.headings.find(([, named]) => named === column)?.[0] ?? "";
        const chosen = this.chosen.get(column) ?? { heading: own, name: column };
        const heading = element("select", { id: `column-${column}` }, element("option", { value: "" }, "– none –"));
        for (const [text] of this.headings) heading.append(element("option", { value: text }, text || "(without a name)"));
        heading.value = chosen.heading;
        const unit = element("select", { id: `unit-${column}`, ariaLabel: `Unit of ${words}` });
        for (const [name, symbol] of this.units[column] ?? []) unit.append(element("option", { value: name }, symbol));
        unit.value = chosen.name;
        const show = () => unit.hidden = unit.options.length < 2 || heading.value === "" || heading.value === own;
        for (const select of [heading, unit]) {
            select.addEventListener("change", () => {
                this.chosen.set(column, { heading: heading.value, name: unit.value || column });
                show();
            });
        }
        show();
        const label = element("label", { htmlFor: heading.id }, `${words} `, ...symbol(mark));
        return element("div", { className: "choice" }, label, element("span", { className: "pair" }, heading, unit));
    }

    // The headings that get another text, by turns with that text.
    renamed() {
        const own = (heading, column) => this.headings.some(([text, named]) => text === heading && named === column);
        const chosen = [...this.chosen].filter(([column, { heading }]) => heading !== "" && !own(heading, column));
        return chosen.flatMap(([, { heading, name }]) => [heading, name]);
    }

    async classify() {
        const button = this.form.querySelector("button"), progress = this.form.querySelector("progress");
        button.disabled = true;
        progress.hidden = false;
        await this.attempt(async () => {
            const show = (fraction) => progress.value = fraction;
            const named = await program.run(["rename", "--", ...this.renamed()], this.file);
            const model = this.section.querySelector("#model").value;
            const result = await program.run(["classify", "-", "--format", "csv", "--model", model], named.output, show);
            const words = (await result.errors.text()).trim();
            if (result.status > 1) throw new Error(words);
            const { output } = await program.run(["summary"], result.output);
            this.show(result.output, JSON.parse(await output.text()), words);
        });
        button.disabled = false;
        progress.hidden = true;
    }

    async attempt(work) {
        try {
            await work();
        } catch (error) {
            this.outcome.replaceChildren(element("p", { className: "refused" }, error.message.trim()));
        }
    }

    show(result, { rows, bad, classes, names, first }, words) {
        if (this.link) URL.revokeObjectURL(this.link);
        this.link = URL.createObjectURL(result);
        const download = this.file.name.replace(/\.[^.]*$/, "") + "-classified.csv";
        const counts = Object.entries(classes).map(([name, count]) => `${count} ${name}`);
        if (bad) counts.push(`${bad} with an error, which the column error explains`);
        const shown = SHOWN.map((name) => names.indexOf(name)).filter((at) => first.some((row) => row[at]));
        const head = element("tr", {}, ...shown.map((at) => element("th", { scope: "col" }, names[at])));
        const body = first.map((row) => element("tr", {}, ...shown.map((at) => element("td", {}, row[at]))));
        const caption = element("caption", {}, first.length < rows ? `The first ${first.length} of ${rows} rows` : `${rows} rows`);
        this.outcome.replaceChildren(
            element("p", {}, `${rows} rows: ${counts.join("; ")}. `),
            element("p", {}, element("a", { id: "download", className: "button", href: this.link, download }, `Save ${download}`)),
            element("div", { className: "wide", tabIndex: 0 }, element("table", {}, caption, element("thead", {}, head), element("tbody", {}, ...body))),
            element("details", {}, element("summary", {}, "Which columns were read"), element("pre", {}, words)),
        );
    }
}

new TableOfImpacts(document.getElementById("sheet"));
