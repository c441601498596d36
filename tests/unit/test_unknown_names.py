"""A name that nothing has is refused with what there is: it was ignored once, and a default drawn.

No statistics.
"""

import inspect

import pytest

from kacsim import boltzmann, kac, plan, techniques
from kacsim.cases import make_case, tiny_cases
from kacsim.kernels.provenance import ROOT

CONFIG = ROOT / "config" / "config.yaml"
SIZE = {"n_draws": 5, "n_replicates": 1, "seed": 1}
KAC = {"n_particles": 5, "time": 1.0, "n_draws": 5, "seed": 1}


def test_a_misspelt_parameter_is_refused_with_its_neighbour():
    with pytest.raises(ValueError, match=r"\A[^\n]+\Z") as error:
        make_case("bkw", speed=[1.0], time=[1.0], oversamplin=5.0, **SIZE)
    said = str(error.value)
    assert said == "oversamplin = 5.0: bkw has no such parameter; did you mean oversampling?"


@pytest.mark.parametrize("case", [*tiny_cases()], ids=lambda case: case.id)
def test_every_sampler_refuses_a_foreign_parameter_with_its_own(case):
    given = {name: value for name, value in case.parameters.items() if value is not None}
    with pytest.raises(ValueError, match=r"\A[^\n]+\Z") as error:
        make_case(case.name, **given, xyzzy=3, **SIZE)
    owner = case.parameters.get("algorithm", case.name)
    named = ", ".join(p.name for p in case.sampler.parameters_of(case.parameters))
    assert str(error.value) == f"xyzzy = 3: {owner} has no such parameter; it has {named}"
    assert make_case(case.name, **given, xyzzy=None, **SIZE).parameters == case.parameters


def test_a_misspelt_parameter_is_refused_though_its_value_is_the_default():
    with pytest.raises(ValueError, match=r"^onest = 0\.0: .* did you mean onset\?$"):
        make_case("bkw", speed=[1.0], time=[1.0], onest=0.0, **SIZE)


@pytest.mark.parametrize(
    ("algorithm", "name", "allowed"),
    [
        ("bird", "time_step", "bird has no such parameter; did you mean time?"),
        ("nanbu_sequential", "time_stp", "did you mean time_step?"),
        ("poisson", "xyzzy", "poisson has no such parameter; it has algorithm, "),
        ("poisson", "colision_rate", "did you mean collision_rate?"),
    ],
)
def test_functions_that_take_an_algorithms_own_parameters_refuse_others(algorithm, name, allowed):
    step = {"time_step": 0.5} if algorithm == "nanbu_sequential" else {}
    for function in (
        lambda given: kac.draw(algorithm, **KAC, **step, **given),
        lambda given: kac.fourth_moment(1.0, 5, algorithm=algorithm, **step, **given),
        lambda given: kac.fourth_moment(0.0, algorithm=algorithm, **step, **given),
    ):
        with pytest.raises(ValueError, match=r"\A[^\n]+\Z") as error:
            function({name: 0.25})
        assert str(error.value).startswith(f"{name} = 0.25: ")
        assert allowed in str(error.value)


FAMILIES = (kac, boltzmann, techniques)
PUBLIC = [getattr(family, name) for family in FAMILIES for name in family.__all__]
FUNCTIONS = [one for one in PUBLIC if inspect.isfunction(one)]


def passes_on(function):
    kinds = {one.kind for one in inspect.signature(function).parameters.values()}
    return inspect.Parameter.VAR_KEYWORD in kinds


def test_every_other_public_function_names_its_parameters():
    assert {one for one in FUNCTIONS if passes_on(one)} == {kac.draw, kac.fourth_moment}
    for function in FUNCTIONS:
        if not passes_on(function):
            with pytest.raises(TypeError, match="unexpected keyword argument 'xyzzy'"):
                function(xyzzy=1)


@pytest.mark.parametrize(
    ("config", "said"),
    [
        ({"kac_fig1": {"n_particle": 5}}, "kac_fig1.n_particle: unknown key; did you mean"),
        ({"kac_fgi1": {}}, "kac_fgi1: unknown key; did you mean kac_fig1?"),
        ({"kac_fig1": {"xyzzy": 5}}, "kac_fig1.xyzzy: unknown key; known: engine, n_particles, "),
    ],
)
def test_a_configuration_is_refused_with_what_there_is(config, said):
    with pytest.raises(plan.PlanError) as error:
        plan.Plan(config, [CONFIG])
    assert said in str(error.value)
