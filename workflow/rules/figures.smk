# Stage 3: a dataset becomes a figure in three formats, and its numbers a table.


def labels_of(wildcards):
    """Return what the page of `snakemake --report` calls a figure."""
    texts = plan.report_texts("captions.yaml")[wildcards.item]
    return {"item": texts["label"], "shows": texts["title"]}


def part_of(wildcards):
    """Return whether an item is a figure of its text or a study."""
    printed = labels_of(wildcards)["item"].startswith("Fig.")
    return "Figures" if printed else "Studies and claims"


def category_of(wildcards):
    """Return the text that an item belongs to."""
    texts = plan.report_texts("errata.yaml")
    return texts[wildcards.item.partition("_")[0]]["name"]


rule draw:
    """Draw one figure from its dataset; no computing happens here."""
    input:
        "results/datasets/{item}.nc",
    output:
        report(
            "results/figures/{item}.svg",
            caption="../../reports/figure.rst",
            category=category_of,
            subcategory=part_of,
            labels=labels_of,
        ),
        expand("results/figures/{{item}}.{format}", format=FORMATS[1:]),
    log:
        "logs/draw/{item}.log",
    benchmark:
        "benchmarks/draw/{item}.tsv"
    threads: 1
    resources:
        mem_mb=600,
        runtime=10,
    params:
        code=lambda wildcards: source_hash(*plan.draw_sources(wildcards.item)),
    message:
        "Drawing {wildcards.item}"
    shell:
        "kacsim draw {wildcards.item} --dataset {input} --output {output}"
        " > {log} 2>&1"


# Each item is a target of its own name, so that `snakemake -c2 kac_fig3` works.
for item_name in items.NAMES:

    rule:
        name:
            item_name
        input:
            expand("results/figures/{item}.{format}", item=item_name, format=FORMATS),
