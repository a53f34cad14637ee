function value = M(q, arm)
%M  Joint-space inertia matrix of the planar 2R arm.
%   value = planar_2r.M(q, arm), 2 x 2, kg m^2, symmetric; it depends on q(2) alone.
%   q    2 x 1, rad: angle of link 1 from the x axis, of link 2 from link 1
%   arm  struct of the parameters: see planar_2r.dynamics
  coupling = arm.m2*arm.l1*arm.lc2*cos(q(2));
  M22 = arm.I2 + arm.m2*arm.lc2^2;
  M12 = M22 + coupling;
  M11 = arm.I1 + arm.m1*arm.lc1^2 + arm.m2*arm.l1^2 + M22 + 2*coupling;
  value = [M11, M12;
           M12, M22];
end
