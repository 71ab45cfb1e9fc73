"""Equations to numbers: exact derivatives, C and NumPy functions, and a cache of compiled ones."""

from symid.codegen.build import load_library
from symid.codegen.cache import CodegenWarning
from symid.codegen.equations.program import Program
from symid.codegen.kernel import Kernel, compile_program
from symid.codegen.straight_line.cprint import c_statements

__all__ = ["CodegenWarning", "Kernel", "Program", "c_statements", "compile_program", "load_library"]
