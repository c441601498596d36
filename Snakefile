# Data flows one way: config -> samples -> datasets -> figures -> report.
#
#   results/samples/{case}.nc               one sampler with one set of parameters
#   results/datasets/{item}.nc              what one published item needs, with its errors
#   results/figures/{item}.{png,svg,pdf}    its figure; .csv: the numbers behind it,
#                                           .csv-metadata.json: what they are
#                                           .marks.json: the values behind its marks
#   results/page/                           the kernels that the page runs itself
#   results/report/report.html              everything, with the verdicts; .pdf: printed
#   results/report/runtime.html             how long the jobs took
#
# Each item is a target by name: `snakemake -c2 kac_fig3`.
import os
import re
import shlex
import sys
import time
from pathlib import Path

sys.path.insert(0, str(workflow.current_basedir))

from kacsim import items, plan
from kacsim.jobs import client, console, labels, remaining, server, stages
from kacsim.kernels.provenance import ROOT
from kacsim.report import browser


configfile: ROOT / "config" / "config.yaml"


# `kacsim` in a rule is the interpreter that runs Snakemake on this clone, installed or not;
# a job has one core, so the threads of its linear algebra would only cost their start.
CLIENT = shlex.join([sys.executable, "-S", "-E", client.__file__])
shell.prefix(
    'kacsim() {{ OPENBLAS_NUM_THREADS=1 PYTHONPATH=%s %s "$@"; }}; '
    % (shlex.quote(str(ROOT)), CLIENT)
)
SERVED = os.environ.pop(client.ADDRESS, None) != "off" and workflow.local_exec

START = time.time()
# Cores here, jobs in the queue of a cluster.
AT_A_TIME = workflow.resource_settings.cores or workflow.resource_settings.nodes
FORMATS = ("svg", "png", "pdf", "csv")
BESIDE = ("csv-metadata.json", "marks.json", "sha256")  # what comes with them
# Where no Chromium is installed there is no PDF to make; the run says so at its end.
PRINTED = ["results/report/report.pdf"] if browser.find() else []
# Messages name the last file that sets a key; those of the command line come last.
CONFIG_FILES = sorted(
    workflow.configfiles, key=lambda file: file != ROOT / "config/config.yaml"
)

try:
    the_plan = plan.Plan(config, CONFIG_FILES, workflow.config_settings.config)
except plan.PlanError as error:
    print(error, file=sys.stderr)
    sys.exit(2)

if workflow.is_main_process and not workflow.output_settings.dryrun:
    console.quieten(
        logger,
        [str(file) for file in CONFIG_FILES[1:]],
        ("all", *items.NAMES),
        remaining.Remaining(remaining.weights(the_plan), AT_A_TIME),
    )


wildcard_constraints:
    item="|".join(items.NAMES),
    unit="|".join(map(re.escape, the_plan.units)),


rule all:
    input:
        "results/report/report.html",
        "results/report/runtime.html",
        PRINTED,
        [case.output() for case in the_plan.cases.values()],
        expand("results/datasets/{item}.nc", item=items.NAMES),
        expand("results/figures/{item}.{format}", item=items.NAMES, format=FORMATS),


include: "workflow/rules/sample.smk"
include: "workflow/rules/reduce.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/report.smk"


onstart:
    if SERVED:
        server.start(ROOT)


onsuccess:
    shell(f"kacsim times --since {START}")
    shell(f"kacsim summary --since {START}")
    page = Path("results/report/report.html")
    if not PRINTED and page.exists() and page.stat().st_mtime >= START:
        print(f"results/report/report.pdf: not printed: {browser.NONE}")
