function [t, x] = simulate_ode45(arm, x0, u, t, rel_tol, abs_tol)
%SIMULATE_ODE45  Motion of the planar 2R arm by ode45.
%   [t, x] = planar_2r.simulate_ode45(arm, x0, u, t) gives the states x, one row [q1 q2 qd1 qd2] a
%   time, at the times t (s). Two times are the ends, and ode45 then chooses those in between.
%   [t, x] = planar_2r.simulate_ode45(arm, x0, u, t, rel_tol, abs_tol) sets the tolerances of the
%   error of a step, relative and absolute; without them 1e-9 and 1e-12.
%   arm  struct of the parameters: see planar_2r.dynamics
%   x0   4 x 1, the state at t(1), rad and rad/s
%   u    2 x 1, N m, held constant; or a function handle u(t, x) that gives it
  if nargin < 6
    abs_tol = 1e-12;
  end
  if nargin < 5
    rel_tol = 1e-9;
  end
  if isa(u, 'function_handle')
    rate = @(t, x) planar_2r.state_derivative(x, u(t, x), arm);
  else
    rate = @(t, x) planar_2r.state_derivative(x, u, arm);
  end
  options = odeset('RelTol', rel_tol, 'AbsTol', abs_tol);
  [t, x] = ode45(rate, t, x0, options);
end
