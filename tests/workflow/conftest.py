"""The finished smoke run as a project in which Snakemake is asked."""

import shutil

import pytest
import smoke
from projects import Project


@pytest.fixture(scope="session")
def finished(smoke_run):
    """Return a project in which the smoke run is complete; tests must leave it as it is."""
    project = Project(smoke_run)
    project.said = (smoke_run / smoke.SAID).read_text(encoding="utf-8")
    return project


@pytest.fixture
def project(finished, tmp_path):
    """Return a copy of the finished project, free to be edited."""
    folder = tmp_path / "project"
    shutil.copytree(finished.folder, folder)
    return Project(folder)
