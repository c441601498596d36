"""What a plan should take: tables of its cases and of its items, and the time of the whole."""

from kacsim import costs


def cases_table(plan, chosen):
    """Return a table of cases: the job that draws each, draws, expected seconds and items."""
    job_of, items_of = jobs_of(plan), plan.items_of()
    job_of |= {name: f"{len(parts)} shards" for name, parts in plan.shards.items()}
    rows = [("stage", "seconds", "draws", "job", "case", "for")]
    for case in sorted(chosen, key=lambda case: -case.seconds()):
        amount = f"{case.n_replicates} x {case.n_draws}"
        job, wanted = job_of[case.id], ", ".join(items_of[case.id])
        rows.append(("sample", f"{case.seconds():.2g}", amount, job, case.id, wanted))
    return aligned(rows)


def jobs_of(plan):
    """Return case id -> name of the job that draws the case, or joins its shards."""
    jobs = {case.id: batch.id for batch in plan.batches for case in batch.cases}
    return jobs | {name: name for name in plan.shards}


def number_of_jobs(plan, cases):
    """Return the jobs that draw some cases: batches, shards, and one that joins them."""
    job_of = jobs_of(plan)
    return len({job_of[case.id] for case in cases}) + sum(
        len(plan.shards[case.id]) for case in cases if case.id in plan.shards
    )


def items_table(plan, names):
    """Return a table of items: cases, jobs, and processor seconds, each as if it were run alone."""
    rows = [("item", "cases", "jobs", "in kernels", "seconds")]
    for name in names:
        cases = plan.cases_of[name]
        jobs, kernels = number_of_jobs(plan, cases), sum(case.seconds() for case in cases)
        n = len(cases)
        seconds = kernels + costs.stage_seconds(job=jobs, case=n, item=1, read=n)
        rows.append((name, f"{n}", f"{jobs}", f"{kernels:.1f}", f"{seconds:.1f}"))
    return aligned(rows)


def whole(plan, chosen, names, n_cores):
    """Return what cases and items take together, as one sentence.

    The time on several cores is that of the work shared evenly, or of the longest job.
    """
    kernels, jobs = sum(case.seconds() for case in chosen), number_of_jobs(plan, chosen)
    read = sum(len(plan.cases_of[name]) for name in names)
    beside = costs.stage_seconds(job=jobs, case=len(chosen), item=len(names), read=read)
    seconds = kernels + beside
    ids = {case.id for case in chosen}
    batches = (batch for batch in plan.batches if ids & {case.id for case in batch.cases})
    parts = (part for name in ids & plan.shards.keys() for part in plan.shards[name])
    longest = max((job.seconds() for job in [*batches, *parts]), default=0.0)
    wall = max(seconds / n_cores, longest)
    return (
        f"{len(chosen)} cases in {jobs} jobs for {len(names)} items: {kernels:.0f} s in kernels, "
        f"{seconds:.0f} s of processors, about {wall:.0f} s on {n_cores} cores; compiling and the "
        f"report not counted (costs of {costs.table()['machine']})"
    )


def aligned(rows):
    """Return rows of words as lines with columns below each other, the last one as it is."""
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]) - 1)]
    return "\n".join("  ".join(map(str.ljust, row, (*widths, 0))) for row in rows)
