# Stage 1: cases become samples.


rule compile:
    """Compile the kernels of one module once, before parallel jobs would each compile them."""
    output:
        "results/kernels/{kernels}.txt",
    log:
        "logs/compile/{kernels}.log",
    benchmark:
        "benchmarks/compile/{kernels}.tsv"
    priority: 1000
    threads: 1
    resources:
        mem_mb=800,
        runtime=10,
    params:
        code=lambda wildcards: source_hash(
            *cases.compile_sources(f"{wildcards.kernels}.py")
        ),
    message:
        "Compiling the kernels of {wildcards.kernels}"
    shell:
        "kacsim compile {wildcards.kernels}.py --output {output} > {log} 2>&1"


# Short cases share a job; its outputs have no common wildcard, so each batch is a rule.
for batch in the_plan.batches:

    rule:
        name:
            f"sample_{batch.id}"
        input:
            kernels=batch.cases[0].compiled(),
        output:
            [case.output() for case in batch.cases],
        log:
            f"logs/sample/{batch.id}.log",
        benchmark:
            f"benchmarks/sample/{batch.id}.tsv"
        priority: batch.priority()
        threads: 1
        resources:
            mem_mb=400,
            runtime=batch.minutes(),
        params:
            recipe=batch.arguments(),
            code=source_hash(*batch.cases[0].sources()),
        message:
            f"Sampling {batch.description()}"
        shell:
            "kacsim sample {params.recipe} > {log} 2>&1"
