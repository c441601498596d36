# Stage 3: a dataset becomes a figure in three formats, and its numbers a table.


rule draw:
    """Draw one figure from its dataset; no computing happens here."""
    input:
        "results/datasets/{item}.nc",
    output:
        report(
            "results/figures/{item}.svg",
            caption="../../reports/figure.rst",
            category=labels.category_of,
            subcategory=labels.part_of,
            labels=labels.labels_of,
        ),
        expand(
            "results/figures/{{item}}.{format}",
            format=(*FORMATS[1:], *BESIDE),
        ),
    log:
        "logs/draw/{item}.log",
    benchmark:
        "benchmarks/draw/{item}.tsv"
    threads: 1
    resources:
        mem_mb=600,
        runtime=10,
    params:
        values=lambda wildcards: stages.draw_values(the_plan.cases_of[wildcards.item]),
        code=lambda wildcards: stages.code(stages.draw_roots(wildcards.item)),
    message:
        "Drawing {wildcards.item}"
    shell:
        "kacsim draw {wildcards.item} --dataset {input} --output {output}"
        " > {log} 2>&1"


# Each item is a target of its own name, so that `snakemake -c2 kac_fig3` works. Samples and datasets
# are named too: Snakemake would not make an absent one again for a figure that is there.
for item_name in items.NAMES:

    rule:
        name:
            item_name
        input:
            [case.output() for case in the_plan.cases_of[item_name]],
            f"results/datasets/{item_name}.nc",
            expand("results/figures/{item}.{format}", item=item_name, format=FORMATS),
