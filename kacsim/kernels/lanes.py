"""Lanes of xoshiro256++ side by side, in vector registers: numba has no vectors, LLVM has."""

from llvmlite import ir
from numba.core import cgutils, types
from numba.extending import intrinsic, overload

LANES = 8
WORD = 2**64 - 1


def fill(array, state, start, stop):
    """Fill places start..stop-1 of an array with words, one lane's after another's.

    Parameters
    ----------
    array : uint64[n], holds the state of all lanes too, overwritten
    state : place of the four words of each lane's state, the first words of all lanes first
    start, stop : int, a multiple of `LANES` apart
    """
    for place in range(start, stop):
        at = [state + LANES * k + (place - start) % LANES for k in range(4)]
        s0, s1, s2, s3 = (int(array[k]) for k in at)
        array[place] = (_rotated((s0 + s3) & WORD, 23) + s0) & WORD
        shifted = (s1 << 17) & WORD
        s2 ^= s0
        s3 ^= s1
        array[at[0]], array[at[1]] = s0 ^ s3, s1 ^ s2
        array[at[2]], array[at[3]] = s2 ^ shifted, _rotated(s3, 45)


def _rotated(word, bits):
    return ((word << bits) | (word >> (64 - bits))) & WORD


_WORD = ir.IntType(64)
_VECTOR = ir.VectorType(_WORD, LANES)


@intrinsic
def _fill(typing, array, state, start, stop):
    def generate(context, builder, signature, arguments):
        base = context.make_array(signature.args[0])(context, builder, arguments[0]).data
        state, start, stop = arguments[1:]

        def pointer(place):
            return builder.bitcast(builder.gep(base, [place]), _VECTOR.as_pointer())

        def load(place):
            vector = builder.load(pointer(place))
            vector.align = 8
            return vector

        def store(vector, place):
            builder.store(vector, pointer(place)).align = 8

        def shift(operation, vector, bits):
            return operation(vector, ir.Constant(_VECTOR, [ir.Constant(_WORD, bits)] * LANES))

        def rotated(vector, bits):
            left, right = shift(builder.shl, vector, bits), shift(builder.lshr, vector, 64 - bits)
            return builder.or_(left, right)

        places = [builder.add(state, ir.Constant(_WORD, LANES * k)) for k in range(4)]
        registers = [cgutils.alloca_once_value(builder, load(place)) for place in places]
        stride = ir.Constant(_WORD, LANES)
        with cgutils.for_range_slice(builder, start, stop, stride, intp=_WORD) as (place, _):
            s0, s1, s2, s3 = map(builder.load, registers)
            store(builder.add(rotated(builder.add(s0, s3), 23), s0), place)
            shifted = shift(builder.shl, s1, 17)
            s2, s3 = builder.xor(s2, s0), builder.xor(s3, s1)
            after = (
                builder.xor(s0, s3),
                builder.xor(s1, s2),
                builder.xor(s2, shifted),
                rotated(s3, 45),
            )
            for vector, register in zip(after, registers, strict=True):
                builder.store(vector, register)
        for register, place in zip(registers, places, strict=True):
            store(builder.load(register), place)
        return context.get_dummy_value()

    return types.none(array, types.int64, types.int64, types.int64), generate


@overload(fill, inline="always")
def _(array, state, start, stop):
    return lambda array, state, start, stop: _fill(array, state, start, stop)
