# Stage 2: samples become one dataset per item.


rule reduce:
    """Reduce the samples of one item to values with standard errors and verdicts."""
    input:
        lambda wildcards: [
            f"results/samples/{case.id}.nc"
            for case in the_plan.cases_of[wildcards.item]
        ],
    output:
        "results/datasets/{item}.nc",
    log:
        "logs/reduce/{item}.log",
    benchmark:
        "benchmarks/reduce/{item}.tsv"
    threads: 1
    resources:
        mem_mb=600,
        runtime=10,
    params:
        settings=lambda wildcards: the_plan.settings_json(wildcards.item),
        values=lambda wildcards: stages.reduce_values(
            wildcards.item, the_plan.cases_of[wildcards.item]
        ),
        code=lambda wildcards: stages.code(stages.reduce_roots(wildcards.item)),
    message:
        "Reducing {wildcards.item}"
    shell:
        "kacsim reduce {wildcards.item} --settings {params.settings:q}"
        " --samples results/samples --output {output} > {log} 2>&1"
