/* What is stored here is the output of a program, a character at a time. */
#define OUTPUT (*(volatile unsigned char *)0x10000000)
