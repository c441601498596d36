# Stage 1: cases become samples.


rule compile:
    """Compile the kernels of one sampler once, before parallel jobs would each compile them."""
    output:
        "results/kernels/{unit}.txt",
    log:
        "logs/compile/{unit}.log",
    benchmark:
        "benchmarks/compile/{unit}.tsv"
    priority: 1000
    threads: 1
    resources:
        mem_mb=800,
        runtime=10,
    params:
        code=lambda wildcards: stages.code(
            stages.sample_roots(the_plan.units[wildcards.unit])
        ),
    message:
        "Compiling the kernels of {wildcards.unit}"
    shell:
        "kacsim compile {wildcards.unit} --output {output} > {log} 2>&1"


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
            values=batch.recipes(),
            code=stages.code(stages.sample_roots(batch.cases[0])),
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
        values=lambda wildcards: the_plan.shard(wildcards).recipe(),
        code=lambda wildcards: stages.code(
            stages.sample_roots(the_plan.shard(wildcards))
        ),
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
        values=lambda wildcards: the_plan.cases[wildcards.case].recipe(),
        number=lambda wildcards: len(the_plan.shards[wildcards.case]),
        code=lambda wildcards: stages.code(
            stages.merge_roots(the_plan.cases[wildcards.case])
        ),
    message:
        "Merging {wildcards.case}"
    shell:
        "kacsim merge {params.recipe} --shards {params.number} --output {output}"
        " > {log} 2>&1"
