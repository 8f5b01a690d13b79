// A file of impacts, and the result to save.

// Columns that are shown where they hold something; the file has all.
const SHOWN = ["name", "outcome", "motion", "overall_restitution", "contact_time_s", "models_agree", "class", "probability_capture", "error"];

class TableOfImpacts {
    constructor(section, scene) {
        this.section = section;
        this.form = section.querySelector("form");
        this.mapping = new Mapping(this.form, scene);
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
    }

    // Reads the header of a file and offers its columns.
    async open(file) {
        this.file = file;
        this.section.querySelector("#file-name").textContent = file.name;
        this.form.hidden = true;
        await this.attempt(async () => {
            const { output } = await this.step(["columns"], file);
            this.mapping.open(JSON.parse(await output.text()));
            this.outcome.replaceChildren();
            this.form.hidden = false;
        });
    }

    // Runs a command of the program; a failure is thrown in its words.
    async step(args, input, progress) {
        const result = await program.run(args, input, progress);
        if (result.status > 1) throw new Error((await result.errors.text()).trim());
        return result;
    }

    async classify() {
        const button = this.form.querySelector("button"), progress = this.form.querySelector("progress");
        button.disabled = true;
        progress.hidden = false;
        await this.attempt(async () => {
            const show = (fraction) => progress.value = fraction;
            const { mapping } = this, taken = mapping.taken(), model = mapping.model.value;
            const named = await this.step(["rename", "--", ...mapping.renamed()], this.file);
            const added = taken.flatMap(([column, value]) => [column, withoutMark(value)]);
            const whole = taken.length === 0 ? named : await this.step(["complete", "--", ...added], named.output);
            const result = await this.step(["classify", "-", "--format", "csv", "--model", model], whole.output, show);
            const { output: summary } = await this.step(["summary"], result.output);
            const { output } = await this.step(["restore", "--", ...mapping.headings.map(({ text }) => text)], result.output);
            const words = (await result.errors.text()).trim();
            this.show(output, JSON.parse(await summary.text()), { words, taken });
        });
        progress.hidden = true;
        this.mapping.check();
    }

    async attempt(work) {
        try {
            await work();
        } catch (error) {
            this.outcome.replaceChildren(element("p", { className: "refused" }, error.message.trim()));
        }
    }

    show(result, { rows, bad, classes, names, first }, { words, taken }) {
        if (this.link) URL.revokeObjectURL(this.link);
        this.link = URL.createObjectURL(result);
        const download = this.file.name.replace(/\.[^.]*$/, "") + "-classified.csv";
        const counts = Object.entries(classes).map(([name, count]) => `${count} ${name}`);
        if (bad) counts.push(`${bad} with an error, which the column error explains`);
        const shown = SHOWN.map((name) => names.indexOf(name)).filter((at) => first.some((row) => row[at]));
        const head = element("tr", {}, ...shown.map((at) => element("th", { scope: "col" }, names[at])));
        const body = first.map((row) => element("tr", {}, ...shown.map((at) => element("td", {}, row[at]))));
        const caption = element("caption", {}, first.length < rows ? `The first ${first.length} of ${rows} rows` : `${rows} rows`);
        const notes = [];
        if (taken.length > 0) notes.push(`Taken from the sliders for all rows: ${listed(taken)}.`);
        const assumed = words.match(/columns absent, and what is used: (.*)/)?.[1];
        if (assumed) notes.push(`The table has no column for these; used in all rows: ${assumed}.`);
        const empty = words.match(/empty cells, and what is used: (.*)/)?.[1];
        if (empty) notes.push(`Empty cells, and what is used: ${empty}.`);
        this.outcome.replaceChildren(
            element("p", {}, `${rows} rows: ${counts.join("; ")}. `),
            ...notes.map((note) => element("p", { className: "assumed" }, note)),
            element("p", {}, element("a", { id: "download", className: "button", href: this.link, download }, `Save ${download}`)),
            element("div", { className: "wide", tabIndex: 0 }, element("table", {}, caption, element("thead", {}, head), element("tbody", {}, ...body))),
            element("details", {}, element("summary", {}, "Which columns were read"), element("pre", {}, words)),
        );
    }
}

const impacts = new TableOfImpacts(document.getElementById("sheet"), scene);
