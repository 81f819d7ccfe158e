# Entry point of the program. Switches from the kernel's stack, which contains the arguments, to the program's
# own stack.
    .set noreorder
    .text
    .globl start
    .type start, @function
start:
    move    $a0, $sp                # argument of `start_program`
    lui     $sp, %hi(stack_top)
    addiu   $sp, $sp, %lo(stack_top)
    addiu   $sp, $sp, -16           # space that the o32 ABI reserves for the callee
    j       start_program
    nop
    .size start, . - start
