# Stage 1: cases become samples.
import re


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
        group:
            batch.group()
        threads: 1
        resources:
            mem_mb=batch.megabytes(),
            runtime=batch.minutes(),
        params:
            recipe=batch.arguments(),
            code=source_hash(*batch.cases[0].sources()),
        message:
            f"Sampling {batch.description()}"
        shell:
            "kacsim sample {params.recipe} > {log} 2>&1"


# A long case has no batch: shards of its replicates, then one file with the bytes of them all.
LONG = "|".join(map(re.escape, the_plan.shards)) or "none"


rule shard:
    """Draw some replicates of one case."""
    input:
        kernels=lambda wildcards: the_plan.cases[wildcards.case].compiled(),
    output:
        temp("results/shards/{case}.{number}of{total}.nc"),
    log:
        "logs/sample/{case}.{number}of{total}.log",
    benchmark:
        "benchmarks/sample/{case}.{number}of{total}.tsv"
    wildcard_constraints:
        case=LONG,
    priority: 999
    threads: 1
    resources:
        mem_mb=lambda wildcards: the_plan.shard(wildcards).megabytes(),
        runtime=lambda wildcards: the_plan.shard(wildcards).minutes(),
    params:
        recipe=lambda wildcards: the_plan.shard(wildcards).arguments(),
        code=lambda wildcards: source_hash(*the_plan.shard(wildcards).sources()),
    message:
        "Sampling {wildcards.case}, shard {wildcards.number} of {wildcards.total}"
    shell:
        "kacsim sample {params.recipe} --output {output} > {log} 2>&1"


rule merge:
    """Join the shards of one case."""
    input:
        lambda wildcards: [part.output() for part in the_plan.shards[wildcards.case]],
    output:
        "results/samples/{case}.nc",
    log:
        "logs/sample/{case}.merge.log",
    benchmark:
        "benchmarks/sample/{case}.merge.tsv"
    wildcard_constraints:
        case=LONG,
    threads: 1
    resources:
        mem_mb=lambda wildcards: the_plan.cases[wildcards.case].megabytes(),
        runtime=10,
    params:
        recipe=lambda wildcards: the_plan.cases[wildcards.case].arguments(),
        number=lambda wildcards: len(the_plan.shards[wildcards.case]),
        code=lambda wildcards: source_hash(
            "shards.py", *the_plan.cases[wildcards.case].sources()
        ),
    message:
        "Merging {wildcards.case}"
    shell:
        "kacsim merge {params.recipe} --shards {params.number} --output {output}"
        " > {log} 2>&1"
