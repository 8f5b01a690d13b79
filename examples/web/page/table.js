// A file of impacts: its columns, and the result to save.

// Columns that are shown where they hold something; the file has all.
const SHOWN = ["name", "outcome", "motion", "restitution", "overall_restitution", "contact_time_s", "models_agree", "class", "probability_capture", "error"];

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
            this.names = JSON.parse(await output.text());
            this.chosen = new Map();
            this.showColumns();
            this.outcome.replaceChildren();
            this.form.hidden = false;
        });
    }

    showColumns() {
        const model = this.section.querySelector("#model").value;
        const rows = OFFERED.filter(([, , only]) => !only || model === "both" || only === model).map(([column, label]) => {
            const select = element("select", { id: `column-${column}` }, element("option", { value: "" }, "– none –"));
            for (const name of this.names) select.append(element("option", { value: name }, name || "(without a name)"));
            select.value = this.chosen.get(column) ?? (this.names.includes(column) ? column : "");
            select.addEventListener("change", () => this.chosen.set(column, select.value));
            return element("div", { className: "choice" }, element("label", { htmlFor: select.id }, label), select);
        });
        this.section.querySelector("#columns div").replaceChildren(...rows);
    }

    // The columns of the file that get another name, by turns with that name.
    renamed() {
        return [...this.chosen].filter(([column, name]) => name !== "" && name !== column).flatMap(([column, name]) => [name, column]);
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
