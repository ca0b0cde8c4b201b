// Powers for Yosys: a square for each bit of the exponent. Constant bits cost nothing.
(* techmap_celltype = "$pow" *)
module power(A, B, Y);
    parameter A_SIGNED = 0;
    parameter B_SIGNED = 0;
    parameter A_WIDTH = 1;
    parameter B_WIDTH = 1;
    parameter Y_WIDTH = 1;
    parameter _TECHMAP_CONSTMSK_B_ = 0;
    input [A_WIDTH-1:0] A;
    input [B_WIDTH-1:0] B;
    output [Y_WIDTH-1:0] Y;

    // Above 16 bits an exponent must be constant.
    wire _TECHMAP_FAIL_ = (~_TECHMAP_CONSTMSK_B_ & ~({B_WIDTH{1'b1}} & 16'hffff) & {B_WIDTH{1'b1}}) != 0;

    // The bits of an exponent that is not negative.
    localparam BITS = B_SIGNED ? B_WIDTH - 1 : B_WIDTH;
    wire [Y_WIDTH-1:0] base;
    // The result for a negative exponent: 0, unless the base is 1 or -1.
    wire [Y_WIDTH-1:0] inverse;
    generate
        if (A_SIGNED) begin
            assign base = $signed(A);
            assign inverse = &A ? (B[0] ? {Y_WIDTH{1'b1}} : 1) : A == 1;
        end else begin
            assign base = A;
            assign inverse = A == 1;
        end
    endgenerate

    genvar i;
    generate
        for (i = 0; i < BITS; i = i + 1) begin : bits
            wire [Y_WIDTH-1:0] square;
            wire [Y_WIDTH-1:0] product;
            if (i == 0) begin
                assign square = base;
                assign product = B[0] ? base : 1;
            end else begin
                assign square = bits[i-1].square * bits[i-1].square;
                assign product = B[i] ? bits[i-1].product * square : bits[i-1].product;
            end
        end
    endgenerate
    wire [Y_WIDTH-1:0] positive;
    generate
        if (BITS > 0) assign positive = bits[BITS-1].product;
        else assign positive = 1;
    endgenerate
    assign Y = B_SIGNED && B[B_WIDTH-1] ? inverse : positive;
endmodule
