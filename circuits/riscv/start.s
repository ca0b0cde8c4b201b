# The first instructions of a program, at address 0: a stack, main, and the end.
    .section .start, "ax"
    .globl _start
_start:
    lui  sp, 0x10
    call main
    ebreak
