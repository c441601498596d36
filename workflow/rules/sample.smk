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


rule sample:
    """Draw one case: one algorithm, one set of parameters, all its replicates."""
    input:
        kernels=lambda wildcards: the_plan.cases[wildcards.case].compiled(),
    output:
        "results/samples/{case}.nc",
    log:
        "logs/sample/{case}.log",
    benchmark:
        "benchmarks/sample/{case}.tsv"
    priority: lambda wildcards: the_plan.cases[wildcards.case].priority()
    threads: 1
    resources:
        mem_mb=400,
        runtime=60,
    params:
        recipe=lambda wildcards: the_plan.cases[wildcards.case].arguments(),
        code=lambda wildcards: source_hash(*the_plan.cases[wildcards.case].sources()),
    message:
        "Sampling {wildcards.case}"
    shell:
        "kacsim sample {params.recipe} --output {output} > {log} 2>&1"
