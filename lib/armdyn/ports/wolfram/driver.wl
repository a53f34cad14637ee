(* Terms and simulations of the arm of model.wl, in numbers. *)

Get["model.wl"];

(* Block gives variables values for as long as something is evaluated; in Mathics3 that is quicker
   than rules. With writes the variables into Block, which would not look them up. N is for what
   holds exact numbers alone, such as Sqrt[2]. *)
With[{variables = Join[model`parameters, model`q, model`qd, model`u]},
  driver`terms[row_] := Block[variables, variables = row;
    model`filledIn[N[Flatten[{model`terms, model`dynamics}]]]]];

With[{variables = Join[model`q, model`qd], rates = model`qd},
  driver`rate[x_] := Block[variables, variables = x; N[Join[rates, model`dynamics]]]];

(* A step of the classical Runge-Kutta method: W. Kutta (1901), Beitrag zur naeherungsweisen
   Integration totaler Differentialgleichungen. *)
driver`step[x_, dt_] := Module[{k1, k2, k3, k4},
  k1 = driver`rate[x];
  k2 = driver`rate[x + dt/2 k1];
  k3 = driver`rate[x + dt/2 k2];
  k4 = driver`rate[x + dt k3];
  x + dt/6 (k1 + 2 k2 + 2 k3 + k4)];

(* The states after 0, stride, 2 stride, ... steps. held: the parameters and the inputs. *)
With[{variables = Join[model`parameters, model`u]},
  driver`simulation[held_, x0_, dt_, steps_, stride_] := Block[variables, variables = held;
    model`filledIn[
      NestList[Nest[driver`step[#, dt] &, #, stride] &, x0, Quotient[steps, stride]]]]];
