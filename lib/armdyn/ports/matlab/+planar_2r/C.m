function value = C(q, qd, arm)
%C  Coriolis and centrifugal matrix of the planar 2R arm, in Christoffel form.
%   value = planar_2r.C(q, qd, arm), 2 x 2, kg m^2/s. With it Mdot - 2 C is skew-symmetric.
%   The torque that it stands for is C*qd.
%   q    2 x 1, rad
%   qd   2 x 1, rad/s
%   arm  struct of the parameters: see planar_2r.dynamics
  h = -arm.m2*arm.l1*arm.lc2*sin(q(2));
  value = [ h*qd(2), h*(qd(1) + qd(2));
           -h*qd(1), 0];
end
