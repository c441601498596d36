"""The page of run times."""

import os
import platform
from pathlib import Path

from markupsafe import Markup

from kacsim import files
from kacsim.jobs import times
from kacsim.report import numbers, page


def write(output, folder="."):
    """Write the page of run times of all jobs, each at its last run."""
    stages = times.collect(folder)
    everything = {"all": [job for jobs in stages.values() for job in jobs]} if stages else {}
    rows = [
        {
            "name": name,
            "jobs": jobs,
            "seconds": times.total(jobs, 1),
            "kernels": times.total(jobs, 2),
        }
        for name, jobs in [*stages.items(), *everything.items()]
    ]
    template = page.environment().get_template("runtime.html.j2")
    html = template.render(
        stages=rows,
        fixed=numbers.fixed,
        machine=f"{platform.system()}, {platform.machine()}, {os.cpu_count()} cores",
        style=Markup(page.read_text(page.TEXTS / "style.css")),
    )
    files.replace_file(output, lambda name: Path(name).write_text(html, encoding="utf-8"))
