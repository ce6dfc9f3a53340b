#!/usr/bin/env python3
"""What the raster room's objects hold: no mutable globals, no instruction outside the level it belongs to, no
estimate and no libm function whose bits differ from one machine to the next.

    objects_test.py LIBHALFSPACE_RASTER.A
"""
import platform
import re
import subprocess
import sys

# Symbol (demangled) -> why it may be there. Everything else in a writable section is a problem.
ALLOWED_GLOBALS = {
    # clang's local name is one that objdump does not undo.
    r"halfspace::raster::\(anonymous namespace\)::chosen\(\)::isa|_ZZN9halfspace6raster12_GLOBAL__N_16chosenEvE3isa\.0":
        "the level in use: one atomic for the process, set once by the CPU or HALFSPACE_ISA, or by a test",
    r"halfspace::raster::isa_available\(\)::names(\[abi:cxx11\])?": "a string made once, never written again",
    r"DW\.ref\.__gxx_personality_v0": "the compiler's own reference for unwinding",
}
WRITABLE = re.compile(r"\s(\.(?:data|bss|tdata|tbss)(?:\.(?!rel\.ro)\S*)?)\s")

# glibc chooses these by CPU.
LIBM = re.compile(r"^(pow|exp|exp2|exp10|log|log2|log10|sin|cos|tan|sincos|asin|acos|atan|atan2|sinh|cosh|tanh|cbrt|"
                  r"hypot|fma|expm1|log1p)[fl]?$")

# Intel's manuals: approximate reciprocals and square roots; fused multiply-add.
ESTIMATE = re.compile(r"^v?(rcp|rsqrt)(ps|ss|14\w+|28\w+)|^v?(rcp|rsqrt)ph")
FUSED = re.compile(r"^vf(n?m(add|sub|addsub|subadd))")
# Not in SSE2, the baseline. Enough of SSE3 .. SSE4.2 to see that a function was compiled for it.
SSE4 = re.compile(r"^(pmulld|pmin(ud|sd|uw|sb)|pmax(ud|sd|uw|sb)|pinsr[bdq]|pextr[bdq]|blendv?p[sd]|pblendvb|pblendw|"
                  r"round[sp][sd]|pmov[sz]x\w+|packusdw|ptest|insertps|extractps|pshufb|palignr|pabs[bwd]|pcmpeqq|"
                  r"pcmpgtq|dpp[sd]|mpsadbw|movshdup|movsldup|h(add|sub)p[sd]|lddqu)$")
VEX = re.compile(r"^v[a-z]")
# In a name, or in a mangled one that objdump gave up on (6N_AVX26detail).
LEVEL = re.compile(r"N_(SCALAR|SSE2|SSE4|AVX2|AVX3)(?=\b|\d)")


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def global_problems(table):
    """`table`: output of objdump -t -C."""
    for line in table.splitlines():
        section = WRITABLE.search(line)
        if not section:
            continue
        fields = line[section.end():].split(None, 1)
        name = fields[1] if len(fields) > 1 else ""
        name = re.sub(r"^(\.hidden|\.internal|\.protected)\s+", "", name)
        if not name or name == section.group(1):
            continue
        subject = re.sub(r"^guard variable for ", "", name)
        if not any(re.fullmatch(pattern, subject) for pattern in ALLOWED_GLOBALS):
            yield f"global in {section.group(1)}: {name}"


def code_problems(listing):
    """`listing`: output of objdump -d -C --no-show-raw-insn."""
    function, level, seen = "?", None, set()
    for line in listing.splitlines():
        header = re.match(r"^[0-9a-f]+ <(.*)>:$", line)
        if header:
            function = header.group(1)
            found = LEVEL.search(function)
            level = found.group(1) if found else None
            continue
        instruction = re.match(r"^\s+[0-9a-f]+:\s+(?:(?:rep|repz|repnz|lock|bnd|notrack|data16)\s+)*([a-z][a-z0-9]*)", line)
        if not instruction:
            continue
        name = instruction.group(1)
        why = None
        if ESTIMATE.match(name):
            why = "an estimate: its bits differ between vendors"
        elif FUSED.match(name):
            why = "a fused multiply-add: rounds once where the other levels round twice"
        elif VEX.match(name) and name not in ("verr", "verw") and level not in ("AVX2", "AVX3"):
            why = f"an AVX instruction in code for {level or 'every CPU'}"
        elif SSE4.match(name) and level not in ("SSE4", "AVX2", "AVX3"):
            why = f"an SSE4 instruction in code for {level or 'every CPU'}"
        if why and (function, why) not in seen:
            seen.add((function, why))
            yield f"{function[:160]}: {name}: {why}"


def libm_problems(undefined):
    for line in undefined.splitlines():
        name = line.split()[-1] if line.split() else ""
        if LIBM.match(name):
            yield f"calls libm's {name}"


def self_test():
    table = ("0000 g O .bss\t0008 halfspace::raster::counter\n"
             "0000 l O .data.rel.ro.local\t0008 vtable for X\n"
             "0000 l d .bss\t0000 .bss\n"
             "0000 l O .bss\t0001 halfspace::raster::(anonymous namespace)::chosen()::isa\n"
             "0000 u O .bss._ZGV\t0008 guard variable for f()::table\n")
    assert len(list(global_problems(table))) == 2, list(global_problems(table))

    def code(function, instruction):
        return list(code_problems(f"0000 <{function}>:\n   0:\t{instruction}\n"))
    assert code("std::vector<int>::push_back(int)", "vmovups %ymm0,(%rax)")
    assert code("a::N_SSE4::f()", "vaddps %xmm0,%xmm1,%xmm2")
    assert code("a::N_SCALAR::f()", "pmulld %xmm0,%xmm1")
    assert code("a::N_AVX2::f()", "vfmadd213ps %ymm0,%ymm1,%ymm2")
    assert code("a::N_AVX2::f()", "vrcpps %ymm0,%ymm1")
    assert code("a::N_AVX3::f()", "vrsqrt14ps %zmm0,%zmm1")
    assert not code("a::N_AVX2::f()", "vaddps %ymm0,%ymm1,%ymm2")
    assert not code("_ZN3hwy6N_AVX26detail1fEv", "vaddps %ymm0,%ymm1,%ymm2")
    assert not code("a::N_SSE4::f()", "pmulld %xmm0,%xmm1")
    assert not code("a::f()", "addps %xmm0,%xmm1")
    assert list(libm_problems("                 U powf\n")) and not list(libm_problems("                 U powder\n"))


def main():
    self_test()
    library = sys.argv[1]
    problems = list(global_problems(run("objdump", "-t", "-C", library)))
    problems += libm_problems(run("nm", "-u", library))
    levels = set()
    if platform.machine() == "x86_64":
        listing = run("objdump", "-d", "-C", "--no-show-raw-insn", library)
        problems += code_problems(listing)
        levels = set(LEVEL.findall(listing))
        if not {"SCALAR", "SSE4", "AVX2", "AVX3"} <= levels:
            problems.append(f"levels found: {sorted(levels)}; scalar, sse4, avx2 and avx3 should be there")
    print("\n".join(problems) or f"levels: {sorted(levels)}")
    return 1 if problems else 0


sys.exit(main())
