"""Result files: whole or absent, the same bytes for the same content, errors that name the file."""

import json
import os
import subprocess
import sys

import netCDF4
import numpy as np
import pytest
import xarray as xr

from kacsim import files, store
from kacsim.cases import make_case

SETTINGS = {"n_particles": [3, 7], "time": 1.7, "engine": "forward", "items": {"a": {"b": 1}}}


def content():
    return {
        "counts": store.described(np.arange(6).reshape(2, 3), ("replicate", "bin"), "draws"),
        "large": store.described(np.linspace(0.0, 1.0, 3000), ("draw",), "values", "steps"),
        "gap": store.described([1.5, np.nan], ("replicate",), "with a missing value"),
        "name": store.described(["bird", "poisson"], ("replicate",), "algorithm"),
        "total": store.described(np.float64(3.25), (), "a single number"),
    }


def written(path, what=None, settings=SETTINGS):
    store.write(content() if what is None else what, path, title="A test", settings=settings)
    return path


def test_round_trip(tmp_path):
    found = store.read(written(tmp_path / "new folder" / "a.nc"))
    assert set(found.variables) == set(content())
    for name, (dims, values, attributes) in content().items():
        assert found[name].dims == dims
        np.testing.assert_array_equal(found[name].values, values)
        assert found[name].attrs == attributes
    assert found["counts"].dtype == np.int64
    assert found["large"].dtype == np.float64


def test_attributes_tell_what_made_the_file(tmp_path):
    attributes = store.read(written(tmp_path / "a.nc")).attrs
    assert attributes["settings"] == SETTINGS
    assert attributes["title"] == "A test"
    assert attributes["Conventions"].startswith("CF-")
    assert attributes["source"].startswith("kacsim ")
    for part in ("commit ", "numpy ", "numba ", "Python "):
        assert part in attributes["source"]


def test_datasets_keep_their_attributes(tmp_path):
    dataset = xr.Dataset({"x": ("k", [1.0, 2.0], {"long_name": "x", "units": "1"})})
    dataset = dataset.assign_attrs(published={"claim": 0.5}, settings="replaced by those given")
    found = store.read(written(tmp_path / "a.nc", dataset))
    assert found.attrs["published"] == {"claim": 0.5}
    assert found.attrs["settings"] == SETTINGS
    assert found["x"].attrs == {"long_name": "x", "units": "1"}


def test_same_content_same_bytes(tmp_path):
    first, second = written(tmp_path / "a.nc"), written(tmp_path / "b.nc")
    assert first.read_bytes() == second.read_bytes()
    other = written(tmp_path / "c.nc", settings=SETTINGS | {"time": 1.8})
    assert other.read_bytes() != first.read_bytes()


@pytest.mark.parametrize(
    ("error", "raised"),
    [
        (OSError(28, "No space left on device"), files.StoreError),
        (RuntimeError("NetCDF: HDF error"), (files.StoreError, RuntimeError)),
        (KeyboardInterrupt(), KeyboardInterrupt),
    ],
    ids=lambda value: type(value).__name__,
)
def test_a_failing_write_leaves_the_old_file_and_nothing_else(error, raised, tmp_path):
    path = written(tmp_path / "a.nc")
    before = path.read_bytes()

    def half_way(name):
        with open(name, "w") as file:
            file.write("half")
        raise error

    with pytest.raises(raised):
        files.replace_file(path, half_way)
    assert path.read_bytes() == before
    assert os.listdir(tmp_path) == ["a.nc"]


def test_a_full_disk_is_one_line_that_names_the_file(tmp_path):
    """The library reports a full disk in its own way; files of at most 8 kB stand for one."""
    path = tmp_path / "a.nc"
    code = (
        "import resource, sys; from kacsim.cli import main; "
        "resource.setrlimit(resource.RLIMIT_FSIZE, (8192, 8192)); sys.exit(main(sys.argv[1:]))"
    )
    words = "sample kac --algorithm bird --engine forward --n-particles 5 --time 2 --n-draws 9000"
    command = [sys.executable, "-c", code, *words.split(), "--seed", "1", "--output", str(path)]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    answer = subprocess.run(command, env=environment, capture_output=True, text=True)
    assert answer.stderr.count("\n") == 1, answer.stderr
    assert answer.stderr.startswith(f"{path}: cannot be written")
    assert answer.returncode == 2
    assert os.listdir(tmp_path) == []


def test_new_files_obey_the_umask(tmp_path):
    before = os.umask(0o027)
    try:
        path = written(tmp_path / "a.nc")
    finally:
        os.umask(before)
    assert path.stat().st_mode & 0o777 == 0o640


@pytest.mark.parametrize("place", ["a file/a.nc", "a file/deeper/a.nc", "a folder"])
def test_unwritable_places(place, tmp_path):
    """A file in place of a folder, a folder in place of the file."""
    (tmp_path / "a file").write_text("")
    (tmp_path / "a folder").mkdir()
    path = tmp_path / place
    with pytest.raises(files.StoreError, match=f"{path}: cannot be written: "):
        written(path)
    assert sorted(os.listdir(tmp_path)) == ["a file", "a folder"]
    assert os.listdir(tmp_path / "a folder") == []


@pytest.mark.parametrize("place", ["a file/a.nc", "a folder"])
def test_unwritable_places_are_found_before_any_work(place, tmp_path):
    (tmp_path / "a file").write_text("")
    (tmp_path / "a folder").mkdir()
    with pytest.raises(files.StoreError, match="cannot be written"):
        files.check_writable(tmp_path / place)


def test_a_writable_place_stays_empty(tmp_path):
    files.check_writable(tmp_path / "new" / "a.nc")
    assert os.listdir(tmp_path / "new") == []


def truncated(path):
    data = written(path).read_bytes()
    path.write_bytes(data[: len(data) // 2])


def without_settings(path):
    xr.Dataset({"x": 1.0}).to_netcdf(path)


def with_bad_settings(path):
    xr.Dataset({"x": 1.0}, attrs={"settings": "{not json"}).to_netcdf(path)


@pytest.mark.parametrize(
    "damage",
    [
        lambda path: None,
        lambda path: path.write_bytes(b""),
        lambda path: path.write_text("no NetCDF"),
        lambda path: path.mkdir(),
        truncated,
        without_settings,
        with_bad_settings,
    ],
    ids=["missing", "empty", "text", "folder", "truncated", "no settings", "bad settings"],
)
def test_unreadable_files_are_named_with_what_to_do(damage, tmp_path):
    path = tmp_path / "a.nc"
    damage(path)
    with pytest.raises(files.StoreError, match=r"a\.nc: not a readable result file; remove it"):
        store.read(path)


def sample_case(time=1.7, seed=1):
    common = {"algorithm": "bird", "engine": "forward", "n_particles": 7, "n_replicates": 3}
    return make_case("kac", time=time, n_draws=10, seed=seed, **common)


def test_samples_of_other_settings_are_refused(tmp_path):
    case, path = sample_case(), tmp_path / "a.nc"
    store.write_sample(content(), path, case)
    assert store.read_sample(path, case).attrs["settings"] == json.loads(
        json.dumps(case.settings())
    )
    with pytest.raises(files.StoreError, match=r"a\.nc: drawn with other seed, time; remove it"):
        store.read_sample(path, sample_case(1.8, seed=2))


def test_samples_of_other_code_are_refused(tmp_path):
    case, path = sample_case(), tmp_path / "a.nc"
    store.write(content(), path, title="t", settings=case.settings(), code="0123456789abcdef")
    with pytest.raises(files.StoreError, match=r"a\.nc: drawn by other code; run snakemake"):
        store.read_sample(path, case)


def test_a_dataset_of_another_item_is_refused(tmp_path):
    dataset = xr.Dataset({"x": 1.0}, attrs={"item": "kac_fig4"})
    path = written(tmp_path / "a.nc", dataset)
    assert store.read_dataset(path, "kac_fig4")["x"] == 1.0
    with pytest.raises(files.StoreError, match=r"a\.nc: holds kac_fig4, not kac_fig5"):
        store.read_dataset(path, "kac_fig5")


@pytest.mark.parametrize("name", ["counts", "large", "gap", "total"])
def test_a_changed_value_is_noticed(name, tmp_path):
    path = written(tmp_path / "a.nc")
    with netCDF4.Dataset(path, "a") as file:
        flat = np.atleast_1d(file[name][...])
        flat.flat[0] += 1
        file[name][...] = flat.reshape(file[name].shape)
    with pytest.raises(files.StoreError, match="not a readable result file"):
        store.read(path)


def test_a_changed_attribute_is_noticed(tmp_path):
    path = written(tmp_path / "a.nc")
    with netCDF4.Dataset(path, "a") as file:
        file.title = "Another test"
    with pytest.raises(files.StoreError, match="not a readable result file"):
        store.read(path)


def test_no_flipped_byte_changes_what_is_read(tmp_path):
    """Every 7th byte, one at a time: either the file is refused or the content is the same."""
    path = written(tmp_path / "a.nc", {"counts": content()["counts"], "name": content()["name"]})
    whole, good = path.read_bytes(), store.read(path)
    refused = 0
    for place in range(0, len(whole), 7):
        broken = bytearray(whole)
        broken[place] ^= 0x10
        other = tmp_path / f"b{place}.nc"
        other.write_bytes(broken)
        try:
            assert store.read(other).identical(good)
        except files.StoreError:
            refused += 1
        other.unlink()
    assert refused > 50


def test_sums_name_the_file_that_has_changed(tmp_path):
    figures = [tmp_path / "a.png", tmp_path / "a.pdf"]
    for file in figures:
        file.write_bytes(b"content")
    files.write_sums(figures, tmp_path / "a.sha256")
    files.check_sums(tmp_path / "a.sha256")
    figures[0].write_bytes(b"Content")
    with pytest.raises(files.StoreError, match=r"a\.png: has changed; remove it"):
        files.check_sums(tmp_path / "a.sha256")
    figures[0].unlink()
    with pytest.raises(files.StoreError, match=r"a\.sha256: cannot be read"):
        files.check_sums(tmp_path / "a.sha256")
