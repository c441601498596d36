"""What catalogues, reviewers and machines read: true, and derived where it can be."""

import re
import tomllib

import pytest
import yaml

import kacsim
from kacsim import files, plan
from kacsim.commands import keys
from kacsim.kernels.provenance import ROOT


def text(path):
    return (ROOT / path).read_text(encoding="utf-8")


def locked(library):
    return re.search(rf"^{re.escape(library)}==([^ ;]+)", text("environment.txt"), re.M | re.I)[1]


def test_the_page_of_all_keys_is_that_of_the_schema():
    """Else: python -m kacsim keys --output config/README.md"""
    page = keys.page(files.read_yaml(plan.SCHEMA))
    assert text("config/README.md") == page
    config = plan.read_config(ROOT / "config/config.yaml")
    for name, section in config.items():
        assert f"\n## {name}\n" in page if isinstance(section, dict) else f"| `{name}` |" in page


@pytest.mark.parametrize("library", ["ruff", "snakefmt"])
def test_hooks_have_the_versions_of_the_gate(library):
    repos = yaml.safe_load(text(".pre-commit-config.yaml"))["repos"]
    (found,) = [one["rev"] for one in repos if library in one["repo"]]
    assert found == f"v{locked(library)}"


def test_everything_that_is_asked_for_is_locked():
    project = tomllib.loads(text("pyproject.toml"))
    groups = project["dependency-groups"]
    wanted = [one for group in groups.values() for one in group if isinstance(one, str)]
    assert {"include-group": "test"} in groups["dev"]
    for library in [*project["project"]["dependencies"], *wanted]:
        assert locked(library.replace("_", "-"))


def test_the_version_is_said_once():
    assert yaml.safe_load(text("CITATION.cff"))["version"] == kacsim.__version__
    assert f"\n## {kacsim.__version__}\n" in text("CHANGELOG.md")


def test_actions_are_pinned_and_may_read_only():
    workflow = yaml.safe_load(text(".github/workflows/ci.yml"))
    assert workflow["permissions"] == {"contents": "read"}
    steps = [step for job in workflow["jobs"].values() for step in job["steps"]]
    for step in steps:
        assert "uses" not in step or re.search(r"@[0-9a-f]{40}$", step["uses"])


def test_the_manifest_of_a_check_begins_as_a_document():
    assert text("codecheck.yml").startswith("---\n")
    assert yaml.safe_load(text("codecheck.yml"))["paper"]["authors"]
