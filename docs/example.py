"""Use what a run has left: samples, datasets and estimators, from Python.

Run it in the folder where Snakemake ran: ``PYTHONPATH=. .venv/bin/python docs/example.py``.
"""

import json
from pathlib import Path

import xarray as xr

from kacsim import boltzmann, kac

# A sample file explains itself: what was drawn, with which settings, by which versions.
path = sorted(Path("results/samples").glob("kac-bird-*.nc"))[0]
sample = xr.open_dataset(path)
settings = json.loads(sample.attrs["settings"])
print(sample.attrs["title"])
print("drawn by", sample.attrs["source"], "with seed", settings["seed"])
for name, variable in sample.data_vars.items():
    print(f"  {name}{list(variable.dims)}: {variable.attrs['long_name']}")

# Its mean fourth moment, beside the exact one of the same finite-N process.
moment = sample["moment"].sel(order=4) if "order" in sample.indexes else sample["moment"][:, 3]
error = float(moment.std(ddof=1)) / len(moment) ** 0.5
exact = kac.fourth_moment(settings["time"], settings["n_particles"], algorithm="bird")
print(f"E[v**4] = {float(moment.mean()):.4f} +- {error:.4f}, exact {exact:.4f}")

# A dataset holds what one figure shows, with standard errors.
figure = xr.open_dataset("results/datasets/kac_fig9.nc")
print(figure.attrs["title"])
print(figure)

# The estimators need no files.
probe = kac.estimate_density(6.0, 0.4, n_realizations=20_000, seed=1)
print(
    f"f(6, 0.4) = {probe.mean:.3e} +- {probe.standard_error:.1e}, exact {kac.density(6.0, 0.4):.3e}"
)
rare = boltzmann.estimate_bkw_fraction(6.0, 1.0, n_realizations=20_000, seed=1)
print(f"fraction faster than 6 c_q: {rare.mean:.3e} +- {rare.standard_error:.1e}")
