% Prints what Octave's fuzzy-logic-toolkit answers. usage: octave-cli octave_answers.m FOLDER
% FOLDER/jobs has one line for each job: KEY POINTS OWN. Rules are in FOLDER/KEY.fis, inputs in FOLDER/KEY.inputs, a row each.
% Output: 'KEY: answer ROW OUTPUT LEAST ANSWER GREATEST', 'KEY: silent ROW OUTPUT' where no rule fires,
% 'KEY: failed MESSAGE', and 'all answered' in the end. The integral that Octave samples answers between LEAST and GREATEST.
1;

% Takes over two definitions of .fis files, unless the job wants Octave's own: a Takagi-Sugeno system counts every rule,
% and a bisector is a place, not the index of a sample.
function answer_job (folder, key, points, own)
  fis = readfis (fullfile (folder, [key ".fis"]));
  inputs = dlmread (fullfile (folder, [key ".inputs"]));
  crisp = strcmp (fis.type, "sugeno");
  if (crisp && ! own)
    fis.aggMethod = "sum";
  endif
  for row = 1 : rows (inputs)
    try
      [answers, ~, ~, sets] = evalfis (inputs(row, :), fis, points);
    catch failure
      % So it ends for a Takagi-Sugeno system where no rule fires.
      if (! (crisp && any (strfind (failure.message, "next_agg_output(1,_): out of bound"))))
        rethrow (failure);
      endif
      answers = NaN (1, columns (fis.output));
    end_try_catch
    for o = 1 : columns (fis.output)
      answer = answers(o);
      least = greatest = answer;
      if (! crisp && ! any (sets(:, o)))
        % Octave divides zero by zero, or takes all samples for maxima.
        answer = NaN;
      endif
      if (! crisp && ! isnan (answer))
        x = linspace (fis.output(o).range(1), fis.output(o).range(2), points);
        if (strcmp (fis.defuzzMethod, "bisector") && ! own)
          answer = x(answer);
        endif
        [least, greatest] = limits (fis.defuzzMethod, x, sets(:, o)', answer);
      endif
      if (isnan (answer))
        printf ("%s: silent %d %d\n", key, row, o);
      else
        printf ("%s: answer %d %d %.17g %.17g %.17g\n", key, row, o, least, answer, greatest);
      endif
    endfor
  endfor
endfunction

% Where the exact answer may be, if samples Y at X gave ANSWER. Sets are continuous.
function [least, greatest] = limits (method, x, y, answer)
  h = x(2) - x(1);
  if (strcmp (method, "centroid"))
    % Octave's integrals are those of the polyline through the samples. A slope that changes by S within a step adds at most
    % h^2 S / 8 to one, and the sum of second differences is h S. By the polyline, the moment about ANSWER is zero.
    area = trapz (x, y);
    least = answer - slack (h, (x - answer) .* y) / area;
    greatest = answer + slack (h, (x - answer) .* y) / area;
  elseif (strcmp (method, "bisector"))
    left = cumtrapz (x, y);
    margin = slack (h, y);
    least = min ([x(left >= left(end) / 2 - margin), x(end)]) - h;
    greatest = max ([x(left <= left(end) / 2 + margin), x(1)]) + h;
  else
    % The slopes beside a step limit how far the set may rise above both of its samples: twice that, for slopes that grow.
    % Whisker takes heights for equal that differ by a share of 1e-9.
    d = [0, diff(y), 0];
    rise = 2 * min (max (d(1 : end - 2), 0), max (- d(3 : end), 0));
    highest = find (max (y(1 : end - 1), y(2 : end)) + rise >= (1 - 2e-9) * max (y));
    near = x([highest, highest + 1]);
    top = x(y == max (y));
    % A mean over several plateaus counts a sample more or less of each.
    runs = 1 + sum (diff (top) > 1.5 * h);
    spread = h + (runs > 1) * (max (top) - min (top)) * runs / numel (top);
    least = answer - (min (top) - min (near)) - spread;
    greatest = answer + (max (near) - max (top)) + spread;
    if (max (near) - min (near) > max (top) - min (top) + 0.02 * (x(end) - x(1)))
      % Another place has almost the same height.
      least = -Inf;
      greatest = Inf;
    endif
  endif
endfunction

% Twice the bound, for slopes that change back within a step.
function s = slack (h, y)
  s = 2 * h / 8 * sum (abs (diff (y, 2)));
endfunction

pkg load fuzzy-logic-toolkit
warning ("off", "all");
folder = argv (){end};
jobs = textscan (fopen (fullfile (folder, "jobs")), "%s %d %d");
for j = 1 : rows (jobs{1})
  key = jobs{1}{j};
  try
    answer_job (folder, key, double (jobs{2}(j)), jobs{3}(j));
  catch failure
    printf ("%s: failed %s\n", key, strtrim (failure.message));
  end_try_catch
endfor
puts ("all answered\n");
