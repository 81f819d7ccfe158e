# memcpy that copies two words with each instruction. Compilers generate code that copies one word.
    .set micromips
    .set noreorder
    .macro copy_eight_words offset
    lwp     $t0, 0+\offset($a1)
    lwp     $t2, 8+\offset($a1)
    lwp     $t4, 16+\offset($a1)
    lwp     $t6, 24+\offset($a1)
    swp     $t0, 0+\offset($a0)
    swp     $t2, 8+\offset($a0)
    swp     $t4, 16+\offset($a0)
    swp     $t6, 24+\offset($a0)
    .endm

    .section .text.memcpy, "ax", @progbits
    .globl memcpy
    .type memcpy, @function
    .ent memcpy
memcpy:
    move    $v0, $a0
    or      $v1, $a0, $a1
    andi    $v1, $v1, 3
    bnezc   $v1, .Lbytes
    addiu   $a2, $a2, -64
    bltz    $a2, .Lafter_blocks
    nop
.Lblocks:
    copy_eight_words 0
    copy_eight_words 32
    addiu   $a2, $a2, -64
    addiu   $a1, $a1, 64
    bgez    $a2, .Lblocks
    addiu   $a0, $a0, 64
.Lafter_blocks:                     # the lower bits of $a2 are still the lower bits of the size
    andi    $v1, $a2, 32
    beqzc   $v1, .Lafter_eight_words
    copy_eight_words 0
    addiu   $a1, $a1, 32
    addiu   $a0, $a0, 32
.Lafter_eight_words:
    andi    $v1, $a2, 16
    beqzc   $v1, .Lafter_four_words
    lwp     $t0, 0($a1)
    lwp     $t2, 8($a1)
    swp     $t0, 0($a0)
    swp     $t2, 8($a0)
    addiu   $a1, $a1, 16
    addiu   $a0, $a0, 16
.Lafter_four_words:
    andi    $v1, $a2, 8
    beqzc   $v1, .Lafter_two_words
    lwp     $t0, 0($a1)
    addiu   $a1, $a1, 8
    swp     $t0, 0($a0)
    addiu   $a0, $a0, 8
.Lafter_two_words:
    andi    $v1, $a2, 4
    beqzc   $v1, .Lafter_words
    lw      $t0, 0($a1)
    addiu   $a1, $a1, 4
    sw      $t0, 0($a0)
    addiu   $a0, $a0, 4
.Lafter_words:
    andi    $a2, $a2, 3
.Lbytes:
    beqzc   $a2, .Ldone
.Lnext_byte:
    lbu     $v1, 0($a1)
    addiu   $a1, $a1, 1
    addiu   $a2, $a2, -1
    sb      $v1, 0($a0)
    bnez    $a2, .Lnext_byte
    addiu   $a0, $a0, 1
.Ldone:
    jrc     $ra
    .end memcpy
    .size memcpy, . - memcpy
