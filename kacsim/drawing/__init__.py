"""How figures are drawn and kept: their style, the numbers behind their marks, other widths."""
