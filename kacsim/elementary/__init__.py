"""Elementary functions with the same bits on every machine, for kernels and the samplers' tables.

They use only operations whose result IEEE 754 fixes: + - * / and square roots of float64, rounded
to nearest, comparisons, and integer and bit operations. A mathematical library chooses other code
by the processor, so that its exp or log of one number may differ in the last bit between machines.
numba contracts no product and sum into one operation unless it is asked to. The constants are made
by decimal arithmetic.

Each errs by at most 1 unit in the last place, erfc and the normal cumulative function by at most 4
(tests/unit/test_elementary.py).
"""
