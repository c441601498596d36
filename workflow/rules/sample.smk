# Stage 1: cases become samples.


rule compile_kernels:
    """Compile all kernels once, before parallel jobs would each compile them."""
    output:
        "results/kernels.txt",
    log:
        "logs/compile_kernels.log",
    benchmark:
        "benchmarks/compile_kernels.tsv"
    threads: 1
    resources:
        mem_mb=800,
        runtime=10,
    params:
        code=source_hash(*KERNEL_SOURCES),
    message:
        "Compiling the kernels"
    shell:
        "{KACSIM} compile --output {output} > {log} 2>&1"


rule sample:
    """Draw one case: one algorithm, one set of parameters, all its replicates."""
    input:
        kernels=ancient(rules.compile_kernels.output),
    output:
        "results/samples/{case}.nc",
    log:
        "logs/sample/{case}.log",
    benchmark:
        "benchmarks/sample/{case}.tsv"
    threads: 1
    priority: lambda wildcards: the_plan.cases[wildcards.case].priority()
    resources:
        mem_mb=400,
        runtime=60,
    params:
        recipe=lambda wildcards: the_plan.cases[wildcards.case].arguments(),
        code=lambda wildcards: source_hash(*the_plan.cases[wildcards.case].sources()),
    message:
        "Sampling {wildcards.case}"
    shell:
        "{KACSIM} sample {params.recipe} --output {output} > {log} 2>&1"
