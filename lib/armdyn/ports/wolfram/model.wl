(* What the driver needs of planar_2r.wl: its variables in order, its terms, its accelerations. *)

Get["planar_2r.wl"];

model`parameters = {l1, l2, lc1, lc2, m1, m2, I1, I2, g, viscous1, viscous2, coulomb1, coulomb2};
model`q = q;
model`qd = qd;
model`u = u;
model`terms := {mMatrix, cMatrix, gVec, fVec, potentialEnergy};
model`dynamics := dynamics;

(* Evaluates with the values that variables have at the time put into the matrices, once. *)
SetAttributes[model`filledIn, HoldFirst];
model`filledIn[expression_] := Block[
  {mMatrix = mMatrix, cMatrix = cMatrix, gVec = gVec, fVec = fVec}, expression];
