# Stage 4: datasets and figures become the report.


rule report:
    """Write one HTML file with every figure, every number and every verdict."""
    input:
        datasets=expand("results/datasets/{item}.nc", item=items.NAMES),
        figures=expand("results/figures/{item}.svg", item=items.NAMES),
        texts=[ROOT / "reports" / name for name in plan.REPORT_FILES],
    output:
        "results/report/report.html",
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
        code=source_hash("report.py", "store.py"),
    message:
        "Writing the report"
    shell:
        "kacsim report --items {params.wanted} --datasets results/datasets"
        " --figures results/figures --output {output} > {log} 2>&1"
