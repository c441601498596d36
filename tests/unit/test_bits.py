"""One set of bits: kernels call no mathematical library, and libraries change no sample.

Two of the tests compile every kernel, for half a minute each.
"""

import bits
import numba
import pytest
from llvmlite import binding

CIRCUMSTANCES = {"host": {}, "generic": {"NUMBA_CPU_NAME": "generic", **bits.switched()}}


@pytest.fixture(scope="module")
def reference():
    """Return the digests of this process."""
    return bits.digests()


@pytest.mark.parametrize("processor", CIRCUMSTANCES)
def test_kernels_call_no_library_and_contract_nothing(processor, reference, tmp_path):
    """The generic processor knows no instruction of the last twenty years, nor do the libraries."""
    environment = CIRCUMSTANCES[processor] | {"KACSIM_CACHE_DIR": str(tmp_path)}
    told = bits.run("--assembly", **environment)
    assert told["sizes"].keys() == bits.kernels().keys()
    assert min(told["sizes"].values()) > 1000
    assert told["calls"] == {}
    assert told["contracted"] == {}
    assert told["digests"] == reference


def test_vector_code_of_the_libraries_changes_no_sample(reference):
    told = bits.run(**bits.switched())
    assert told["digests"] == reference
    # Negative control: what they give does change, where the processor leaves them a choice.
    if binding.get_host_cpu_features().get("fma"):
        assert told["libraries"] != bits.libraries()


def test_a_call_and_a_contraction_are_told():
    """Negative controls of the reading of assembly."""
    bits.libraries()
    assert set(bits.calls(next(iter(bits.through_library.inspect_asm().values())))) == {
        "exp",
        "log",
        "sin",
    }
    contracted = numba.njit("f8(f8, f8, f8)", fastmath={"contract"})(lambda a, b, c: a * b + c)
    found = bits.contractions(next(iter(contracted.inspect_asm().values())))
    assert bool(found) == bool(binding.get_host_cpu_features().get("fma", True))
    assert bits.contractions("\tfmadd d0, d1, d2, d3\n\tfmla v0.2d, v1.2d, v2.2d\n")
    assert bits.calls("\tbl\tpow\n") == ["pow"]
    assert not bits.contractions("\tmulsd %xmm1, %xmm0\n\taddsd %xmm2, %xmm0\n")
