// Entry point of the program: sets up the stack and the trap vector.
    .option arch, +zicsr
    .section .text.start, "ax", @progbits
    .globl start
    .type start, @function
start:
    la sp, stack_top
    la t0, fault
    csrw mtvec, t0
    j start_on_stack
    .size start, . - start
