"""The product of two 64-bit integers in full, which no Python integer type of numba holds."""

from llvmlite import ir
from numba.core import types
from numba.extending import intrinsic, overload


def product(a, b):
    """Return (high, low) 64 bits of the product of two uint64."""
    whole = int(a) * int(b)
    return whole >> 64, whole & (2**64 - 1)


@intrinsic
def _product(typing, a, b):
    def generate(context, builder, signature, arguments):
        wide = ir.IntType(128)
        whole = builder.mul(*(builder.zext(argument, wide) for argument in arguments))
        high = builder.trunc(builder.lshr(whole, ir.Constant(wide, 64)), ir.IntType(64))
        low = builder.trunc(whole, ir.IntType(64))
        return context.make_tuple(builder, signature.return_type, (high, low))

    return types.UniTuple(types.uint64, 2)(types.uint64, types.uint64), generate


@overload(product, inline="always")
def _(a, b):
    return lambda a, b: _product(a, b)
