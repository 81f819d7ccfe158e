// memcpy that copies five words at a time; code from GCC would use three registers.
    .syntax unified
    .cpu cortex-m0plus
    .thumb
    .section .text.memcpy, "ax", %progbits
    .global memcpy
    .type memcpy, %function
    .thumb_func
memcpy:
    push {r4-r7, lr}
    mov ip, r0
    movs r3, r0
    orrs r3, r1
    lsls r3, r3, #30
    bne .Lbytes
    subs r2, #40
    blo .Lafter_blocks
.Lblocks:
    ldmia r1!, {r3-r7}
    stmia r0!, {r3-r7}
    ldmia r1!, {r3-r7}
    stmia r0!, {r3-r7}
    subs r2, #40
    bhs .Lblocks
.Lafter_blocks:
    adds r2, #36
    blo .Lafter_words
.Lwords:
    ldmia r1!, {r3}
    stmia r0!, {r3}
    subs r2, #4
    bhs .Lwords
.Lafter_words:
    adds r2, #4
.Lbytes:
    subs r2, #1
    blo .Ldone
    ldrb r3, [r1, r2]
    strb r3, [r0, r2]
    b .Lbytes
.Ldone:
    mov r0, ip
    pop {r4-r7, pc}
    .size memcpy, . - memcpy
