function xd = state_derivative(x, u, arm)
%STATE_DERIVATIVE  The planar 2R arm as a first-order system.
%   xd = planar_2r.state_derivative(x, u, arm), 4 x 1, is [qd; qdd] for the state x = [q; qd].
%   x    4 x 1, rad and rad/s
%   u    2 x 1, N m
%   arm  struct of the parameters: see planar_2r.dynamics
  q = x(1:2);
  qd = x(3:4);
  xd = [qd; planar_2r.dynamics(q, qd, u, arm)];
end
