"""The kernels again for the page of the report: the same functions, compiled to WebAssembly."""
