// Shifts by amounts of 32 bits and more for Yosys, which takes the lowest 32 bits of a constant amount for a number
// with a sign.
(* techmap_celltype = "$shl $shr $sshl $sshr" *)
module wide_shift(A, B, Y);
    parameter A_SIGNED = 0;
    parameter B_SIGNED = 0;
    parameter A_WIDTH = 1;
    parameter B_WIDTH = 1;
    parameter Y_WIDTH = 1;
    parameter _TECHMAP_CELLTYPE_ = "";
    input [A_WIDTH-1:0] A;
    input [B_WIDTH-1:0] B;
    output [Y_WIDTH-1:0] Y;

    wire _TECHMAP_FAIL_ = B_WIDTH < 32;

    // No vector has so many bits that more bits of the amount matter.
    localparam BITS = B_WIDTH < 24 ? B_WIDTH : 24;
    wire [B_WIDTH:0] long = B;
    wire is_far = |long[B_WIDTH:BITS];
    wire [Y_WIDTH-1:0] near;
    wire [Y_WIDTH-1:0] far;
    generate
        if (A_SIGNED) begin
            wire signed [A_WIDTH-1:0] number = A;
            if (_TECHMAP_CELLTYPE_ == "$shl" || _TECHMAP_CELLTYPE_ == "$sshl") assign near = number << B[BITS-1:0];
            else if (_TECHMAP_CELLTYPE_ == "$shr") assign near = number >> B[BITS-1:0];
            else assign near = number >>> B[BITS-1:0];
        end else begin
            if (_TECHMAP_CELLTYPE_ == "$shl" || _TECHMAP_CELLTYPE_ == "$sshl") assign near = A << B[BITS-1:0];
            else assign near = A >> B[BITS-1:0];
        end
        if (A_SIGNED && _TECHMAP_CELLTYPE_ == "$sshr") assign far = {Y_WIDTH{A[A_WIDTH-1]}};
        else assign far = 0;
    endgenerate
    assign Y = is_far ? far : near;
endmodule
