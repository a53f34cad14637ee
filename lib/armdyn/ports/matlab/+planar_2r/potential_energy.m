function value = potential_energy(q, arm)
%POTENTIAL_ENERGY  Potential energy of the planar 2R arm.
%   value = planar_2r.potential_energy(q, arm), scalar, J, zero with both centres of mass at the
%   height of joint 1.
%   q    2 x 1, rad
%   arm  struct of the parameters: see planar_2r.dynamics
  height1 = arm.lc1*sin(q(1));
  height2 = arm.l1*sin(q(1)) + arm.lc2*sin(q(1) + q(2));
  value = arm.g*(arm.m1*height1 + arm.m2*height2);
end
