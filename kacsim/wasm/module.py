"""numba's code for another machine: what it hands to LLVM, compiled to WebAssembly.

Kernels call nothing outside but memory, which `RUNTIME` gives: numbers are IEEE's on either machine
and no operation is contracted, so that the bits are those of the run.
"""

import re

import llvmlite.binding as llvm

from kacsim.wasm import sections

TRIPLE = "wasm32-unknown-unknown"
FEATURES = "+simd128,+bulk-memory,+nontrapping-fptoint,+sign-ext"
FREE = "free_from"
KEPT = (FREE, "__multi3")  # the latter is called by what LLVM makes last

# 128-bit products by halves, without a call; memory that is given back all at once.
RUNTIME = """
define i128 @product(i128 %a, i128 %b) alwaysinline {
  %a64 = trunc i128 %a to i64
  %b64 = trunc i128 %b to i64
  %a0 = and i64 %a64, 4294967295
  %a1 = lshr i64 %a64, 32
  %b0 = and i64 %b64, 4294967295
  %b1 = lshr i64 %b64, 32
  %a_ = insertelement <2 x i64> poison, i64 %a0, i32 0
  %as = insertelement <2 x i64> %a_, i64 %a1, i32 1
  %b0_ = insertelement <2 x i64> poison, i64 %b0, i32 0
  %b0s = insertelement <2 x i64> %b0_, i64 %b0, i32 1
  %b1_ = insertelement <2 x i64> poison, i64 %b1, i32 0
  %b1s = insertelement <2 x i64> %b1_, i64 %b1, i32 1
  %p = mul <2 x i64> %as, %b0s
  %q = mul <2 x i64> %as, %b1s
  %low = extractelement <2 x i64> %p, i32 0
  %m1 = extractelement <2 x i64> %p, i32 1
  %m2 = extractelement <2 x i64> %q, i32 0
  %high = extractelement <2 x i64> %q, i32 1
  %carry = lshr i64 %low, 32
  %s = add i64 %m1, %carry
  %s0 = and i64 %s, 4294967295
  %s1 = lshr i64 %s, 32
  %t = add i64 %m2, %s0
  %t1 = lshr i64 %t, 32
  %h1 = add i64 %high, %s1
  %h = add i64 %h1, %t1
  %l = mul i64 %a64, %b64
  %h128 = zext i64 %h to i128
  %up = shl i128 %h128, 64
  %l128 = zext i64 %l to i128
  %all = or i128 %up, %l128
  ret i128 %all
}
define void @__multi3(ptr %out, i64 %a, i64 %a1, i64 %b, i64 %b1) {
  %aw = zext i64 %a to i128
  %bw = zext i64 %b to i128
  %all = call i128 @product(i128 %aw, i128 %bw)
  %low = trunc i128 %all to i64
  %up = lshr i128 %all, 64
  %high = trunc i128 %up to i64
  %x = mul i64 %a, %b1
  %y = mul i64 %a1, %b
  %z = add i64 %x, %y
  %h = add i64 %high, %z
  store i64 %low, ptr %out
  %next = getelementptr i8, ptr %out, i32 8
  store i64 %h, ptr %next
  ret void
}
define i32 @numba_attempt_nocopy_reshape(i64 %nd, ptr %dims, ptr %strides, i64 %newnd,
    ptr %newdims, ptr %newstrides, i64 %itemsize, i32 %fortran) {
  %flat = icmp eq i64 %newnd, 1
  %few = icmp ule i64 %nd, 1
  %ok = and i1 %flat, %few
  br i1 %ok, label %same, label %other
same:
  %number = icmp eq i64 %nd, 0
  %from = select i1 %number, ptr %newdims, ptr %strides
  %stride = load i64, ptr %from
  %given = select i1 %number, i64 %itemsize, i64 %stride
  store i64 %given, ptr %newstrides
  ret i32 1
other:
  call void @llvm.trap()
  unreachable
}
@heap = internal global i32 0
declare i32 @llvm.wasm.memory.size.i32(i32)
declare i32 @llvm.wasm.memory.grow.i32(i32, i32)
declare void @llvm.trap()
define i32 @free_from(i32 %place) {
  store i32 %place, ptr @heap
  ret i32 0
}
define ptr @NRT_MemInfo_alloc_aligned(i64 %size, i32 %align) noinline {
  %old = load i32, ptr @heap
  %up = add i32 %old, 63
  %info = and i32 %up, -64
  %data = add i32 %info, 64
  %few = trunc i64 %size to i32
  %end = add i32 %data, %few
  %pages = call i32 @llvm.wasm.memory.size.i32(i32 0)
  %needed = lshr i32 %end, 16
  %enough = icmp ult i32 %needed, %pages
  br i1 %enough, label %give, label %more
more:
  %first = sub i32 %needed, %pages
  %missing = add i32 %first, 64
  %was = call i32 @llvm.wasm.memory.grow.i32(i32 0, i32 %missing)
  %failed = icmp eq i32 %was, -1
  br i1 %failed, label %none, label %give
none:
  call void @llvm.trap()
  unreachable
give:
  store i32 %end, ptr @heap
  %at = inttoptr i32 %info to ptr
  store i64 1, ptr %at
  %d1 = getelementptr i8, ptr %at, i32 8
  store i64 0, ptr %d1
  %d2 = getelementptr i8, ptr %at, i32 16
  %pointer = inttoptr i32 %data to ptr
  store ptr %pointer, ptr %d2
  %d3 = getelementptr i8, ptr %at, i32 24
  store i64 %size, ptr %d3
  %d4 = getelementptr i8, ptr %at, i32 32
  store i64 0, ptr %d4
  ret ptr %at
}
define void @NRT_MemInfo_call_dtor(ptr %info) {
  ret void
}
"""


def machine():
    """Return LLVM's machine for WebAssembly."""
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    target = llvm.Target.from_triple(TRIPLE)
    return target.create_target_machine(cpu="generic", features=FEATURES, opt=3)


def built(entries):
    """Return the bytes of a module that exports functions.

    Parameters
    ----------
    entries : mapping, name -> (function of numba's njit, types of its arguments)
    """
    target = machine()
    whole = _parsed(RUNTIME, target)
    for name, (function, types) in entries.items():
        whole.link_in(_unit(name, function, types, target))
    for function in whole.functions:
        kept = function.name in entries or function.name in KEPT
        if not (function.is_declaration or kept):
            function.linkage = "internal"
    options = llvm.create_pipeline_tuning_options(speed_level=3)
    builder = llvm.create_pass_builder(target, options)
    builder.getModulePassManager().run(whole, builder)
    content = target.emit_object(whole)
    defined = [function.name for function in whole.functions if not function.is_declaration]
    places = {name: place for place, name in enumerate(defined)}
    return sections.exporting(content, {name: places[name] for name in (FREE, *entries)})


def _parsed(text, target):
    layout = f'target datalayout = "{target.target_data}"\ntarget triple = "{TRIPLE}"\n'
    text = re.sub(r"^target (datalayout|triple) = .*$", "", text, flags=re.M)
    return llvm.parse_assembly(layout + text)


def _unit(name, function, types, target):
    """Return a function as a module in which nothing else has a name for others."""
    function.compile(types)
    overload = function.overloads[types]
    text = overload.library.get_llvm_str()
    text, many = re.subn(
        r"= mul (?:nuw |nsw )*i128 (\S+), (\S+)", r"= call i128 @product(i128 \1, i128 \2)", text
    )
    # What errors would say, with the paths of this machine's files: a page asks only whether.
    said = r"(?m)^(@\.const\.picklebuf\.\S+ = internal constant \{[^}]*\}) \{.*\}$"
    text = re.sub(said, r"\1 zeroinitializer", text)
    # Tables that several kernels have are then kept once.
    text = re.sub(
        r"(?m)^(@\S+ = (?:internal|private) )constant ", r"\1unnamed_addr constant ", text
    )
    if many:
        text += "\ndeclare i128 @product(i128, i128)\n"
    found = _parsed(text, target)
    for one in found.functions:
        if not one.is_declaration:
            one.linkage = "internal"
    for one in found.global_variables:
        if not one.is_declaration:
            one.linkage = "internal"
    own = found.get_function(overload.fndesc.llvm_func_name)
    own.linkage, own.name = "external", name
    return found
