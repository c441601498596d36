"""One set of bits: kernels call no mathematical library, and libraries change no sample.

What has been compiled for it also shows that nothing that borrows arrays returns one, and that no
reference is counted in the loops of the kernels that all the time is spent in.

Two of the tests compile every kernel, for half a minute each.
"""

import bits
import numba
import pytest
import references
from llvmlite import binding

from kacsim.kernels.jit import inlined

CIRCUMSTANCES = {"host": {}, "generic": {"NUMBA_CPU_NAME": "generic", **bits.switched()}}
# Kernels that make arrays, or look at parts of one, for each draw or each of its rare steps.
COUNTING = {
    "kacsim.boltzmann.literal.record",
    "kacsim.boltzmann.literal_trap.estimate",
    "kacsim.boltzmann.literal_trap.probe",
    "kacsim.kac.forward.couple_both_ways",
    "kacsim.kac.perfect.couple",
    "kacsim.kac.readings.stopping_times",
}


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
    assert told["borrowers"] > 100
    assert told["lent"] == []
    assert told["counted"].keys() <= COUNTING
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


@inlined
def lent(values):
    return values.size, values[1:]


@numba.njit("f8(i8, f8[:])")
def sum_of_copies(n, values):
    """Make an array each time, which counts references."""
    total = 0.0
    for k in range(n):
        part = values[k:].copy()
        part[0] += 1.0
        total += part.sum()
    return total


AROUND_A_LOOP = """
define void @f(ptr %a, i1 %c) {
entry:
  call void @NRT_incref(ptr %a)
  br label %loop
loop:
  br i1 %c, label %loop, label %end
end:
  call void @NRT_decref(ptr %a)
  ret void
}
"""


def test_references_are_told():
    """Negative controls: a function that returns what it has borrowed, and counts in a loop."""
    lent.compile("(f8[:],)")
    (kind,) = references.borrowers()[f"{__name__}.lent"]
    assert references.holds_an_array(kind)
    (llvm,) = sum_of_copies.inspect_llvm().values()
    assert references.counted_in_loops(llvm)
    assert references.counted_in_loops(AROUND_A_LOOP) == []
    within = AROUND_A_LOOP.replace("loop:", "loop:\n  atomicrmw add ptr %a, i64 1 monotonic")
    assert references.counted_in_loops(within) == ["atomicrmw"]
