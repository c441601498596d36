# Stage 4: datasets and figures become the report, on the page and on paper.

# What the page tells a reader to run: the configuration is given as it was given to this run.
own_files = [file for file in CONFIG_FILES if file != ROOT / "config/config.yaml"]
OPTIONS = plan.recipe_options(own_files, workflow.config_settings.config)


rule page_kernels:
    """Compile the kernels that the page runs itself, and draw what it compares them with."""
    output:
        kernels="results/page/kernels.wasm",
        draws="results/page/draws.json",
    log:
        "logs/compile/page.log",
    benchmark:
        "benchmarks/compile/page.tsv"
    priority: 998
    threads: 1
    resources:
        mem_mb=1000,
        runtime=10,
    params:
        code=stages.code(stages.wasm_roots()),
    message:
        "Compiling the kernels of the page"
    shell:
        "kacsim wasm --module {output.kernels} --draws {output.draws} > {log} 2>&1"


rule report:
    """Write one HTML file with every figure, every number and every verdict."""
    input:
        datasets=expand("results/datasets/{item}.nc", item=items.NAMES),
        figures=expand(
            "results/figures/{item}.{format}",
            item=items.NAMES,
            format=(*FORMATS, "marks.json", "sha256"),
        ),
        kernels="results/page/kernels.wasm",
        draws="results/page/draws.json",
        texts=[ROOT / "reports" / name for name in plan.REPORT_FILES],
    output:
        report(
            "results/report/report.html",
            caption="../../reports/report.rst",
            category="Report",
            labels={"item": "Report", "shows": "everything, with the verdicts"},
        ),
    log:
        "logs/report.log",
    benchmark:
        "benchmarks/report.tsv"
    threads: 1
    resources:
        mem_mb=600,
        runtime=10,
    params:
        wanted=items.NAMES,
        options=OPTIONS,
        code=stages.code(stages.page_roots("page")),
    message:
        "Writing the report"
    shell:
        "kacsim report --items {params.wanted} --datasets results/datasets"
        " --figures results/figures --options={params.options:q} --output {output}"
        " --kernels {input.kernels} --draws {input.draws}"
        " > {log} 2>&1"


rule print_report:
    """Print the report to PDF, where a Chromium is installed."""
    input:
        "results/report/report.html",
    output:
        "results/report/report.pdf",
    log:
        "logs/print.log",
    benchmark:
        "benchmarks/print.tsv"
    threads: 1
    resources:
        mem_mb=1500,
        runtime=10,
    params:
        code=stages.code(stages.page_roots("printing")),
    message:
        "Printing the report"
    shell:
        "kacsim print --report {input} --output {output} > {log} 2>&1"


rule run_times:
    """Write a page of how long the jobs took: apart from the report, which has the same bytes."""
    input:
        "results/report/report.html",
        ROOT / "reports/runtime.html.j2",
        ROOT / "reports/style.css",
    output:
        "results/report/runtime.html",
    log:
        "logs/run_times.log",
    threads: 1
    resources:
        mem_mb=300,
        runtime=10,
    params:
        code=stages.code(stages.page_roots("runtime")),
    message:
        "Writing the page of run times"
    shell:
        "kacsim times --output {output} > {log} 2>&1"
