(* The planar arm with two revolute joints (2R), derived from where its centres of mass are:

     M(q) qdd + C(q, qd) qd + g(q) + f(qd) = u

   Two links in a vertical plane, x to the right, y up, gravity along -y. q1 is the angle of link 1
   from the x axis, q2 that of link 2 relative to link 1. SI units, angles in rad.

   All results are symbolic: give them values by rules, as in mMatrix /. {l1 -> 1, q2 -> Pi/2}.
   C and K are the system's own names, so that the matrices are mMatrix and cMatrix.

     l1, l2      lengths of the links, m
     lc1, lc2    distances from joint to centre of mass, along the links, m
     m1, m2      masses, kg
     I1, I2      inertias about the centres of mass, kg m^2
     g           gravitational acceleration, m/s^2
     viscous1, viscous2    viscous friction of the joints, N m s/rad
     coulomb1, coulomb2    Coulomb friction of the joints, N m *)

q = {q1, q2};
qd = {qd1, qd2};
u = {u1, u2};

masses = {m1, m2};
inertias = {I1, I2};

(* Where the links are: their absolute angles, and the positions of their centres of mass. *)
along[angle_] := {Cos[angle], Sin[angle]};
angles = {q1, q1 + q2};
positions = {lc1 along[q1], l1 along[q1] + lc2 along[q1 + q2]};

(* Velocities are Jacobians times qd. Outer[D, x, q] puts the index of q last, also where x is a
   list of points; of D[x, {q}] Mathematica and Mathics3 make different things there. *)
jacobians = Outer[D, positions, q];
velocities = jacobians . qd;
turns = Outer[D, angles, q] . qd;

(* The kinetic energy K = 1/2 qd.M.qd. cos a cos b + sin a sin b = cos(a - b) is all there is to
   simplify. Simplify would find it too, in several seconds. *)
oneAngle = {
  x_. Cos[a_]^2 + x_. Sin[a_]^2 :> x,
  x_. Cos[a_] Cos[b_] + x_. Sin[a_] Sin[b_] :> x Cos[a - b]};
kineticEnergy = Expand[
  1/2 (masses . Map[# . # &, velocities] + inertias . turns^2)] //. oneAngle;

(* The inertia matrix M: K is quadratic in qd, and M holds its second derivatives. *)
mMatrix = Outer[D[kineticEnergy, #1, #2] &, qd, qd];

(* Christoffel symbols of the first kind,
     h_ijk = 1/2 (dM_ij/dq_k + dM_ik/dq_j - dM_jk/dq_i),
   and C_ij = sum over k of h_ijk qd_k, for which dM/dt - 2 C is skew-symmetric. *)
slopes = Outer[D, mMatrix, q];
christoffel = Table[
  (slopes[[i, j, k]] + slopes[[i, k, j]] - slopes[[j, k, i]])/2,
  {i, 2}, {j, 2}, {k, 2}];
cMatrix = christoffel . qd;

(* The potential energy, zero at the height of joint 1, and its gradient g(q). *)
potentialEnergy = g masses . positions[[All, 2]];
gVec = D[potentialEnergy, {q}];

(* Viscous and Coulomb friction; Sign[0] is 0: there is no stiction. *)
fVec = {viscous1, viscous2} qd + {coulomb1, coulomb2} Sign[qd];

(* The accelerations for the inputs u. Delayed, to be solved with numbers in place: in symbols the
   answer is pages long. *)
dynamics := LinearSolve[mMatrix, u - cMatrix . qd - gVec - fVec];
