#include "host/lab/rules/inference.hpp"

#include <algorithm>
#include <map>
#include <tuple>

namespace whisker::rules {
namespace {

/// Below it, the error of a set counts against a cut at the strength.
constexpr double kWeak = 1e-4;

double crisp_value(const Term& term, const double* inputs) {
  double z = term.constant;
  for (std::size_t i = 0; i < term.coefficients.size(); ++i) z += term.coefficients[i] * inputs[i];
  return z;
}

}  // namespace

double Inference::Proposition::operator()(const RuleBase& base, double x) const {
  return hedged(any ? 1 : base.inputs[input].terms[term].set(x), hedges);
}

Inference::Inference(const RuleBase& base) : base_(base) {
  std::map<std::tuple<std::vector<std::size_t>, double, And, Or>, std::size_t> first;
  for (const Rule& rule : base.rules) {
    std::vector<std::size_t>& steps = steps_.emplace_back();
    bool conjunctive = true;
    for (const Step& step : rule.antecedent) {
      conjunctive = conjunctive && step.kind != Step::Kind::disjunction && step.kind != Step::Kind::negation;
      // Of an operator: a number that no proposition has.
      std::size_t at = SIZE_MAX - static_cast<std::size_t>(step.kind);
      if (step.kind == Step::Kind::proposition) {
        const auto same = [&](const Proposition& p) {
          return p.input == step.input && p.any == step.any && p.hedges == step.hedges &&
                 (p.any || p.term == step.term);
        };
        at = static_cast<std::size_t>(std::find_if(propositions_.begin(), propositions_.end(), same) -
                                      propositions_.begin());
        if (at == propositions_.size())
          propositions_.push_back({step.input, step.term, step.any, step.hedges});
      }
      steps.push_back(at);
    }
    conjunctive_.push_back(conjunctive);
    const std::size_t r = same_as_.size();
    same_as_.push_back(
        first.try_emplace({steps, rule.weight, rule.conjunction, rule.disjunction}, r).first->second);
  }
  for (std::size_t o = 0; o < base.outputs.size(); ++o) prepare(o);
}

void Inference::prepare(std::size_t o) {
  const Output& output = base_.outputs[o];
  Prepared& prepared = outputs_.emplace_back();
  std::vector<Canvas::Set> sets;
  std::vector<std::pair<std::size_t, bool>> of;
  const bool summed = is_weighted(output.defuzzifier) ? !output.merge_terms : output.aggregation == Or::sum;
  const bool merges = summed || output.aggregation == Or::maximum;
  for (std::size_t r = 0; r < base_.rules.size(); ++r) {
    for (const Conclusion& c : base_.rules[r].conclusions) {
      if (c.output != o) continue;
      const std::pair<std::size_t, bool> key{c.term, c.negated};
      const auto at = static_cast<std::size_t>(std::find(of.begin(), of.end(), key) - of.begin());
      const bool product = base_.rules[r].implication == And::product;
      const Part part{same_as_[r], c.term, at, product, 1};
      const auto same = [&](const Part& p) {
        return p.rule == part.rule && p.set == part.set && p.product == part.product;
      };
      const auto found = std::find_if(prepared.parts.begin(), prepared.parts.end(), same);
      if (found == prepared.parts.end() || !merges) {
        prepared.parts.push_back(part);
      } else {
        ++found->times;
      }
      if (at < of.size()) continue;
      of.push_back(key);
      sets.push_back({output.terms[c.term].set, c.negated});
    }
  }
  prepared.sets = sets.size();
  const bool crossings = output.aggregation == Or::maximum;
  if (is_weighted(output.defuzzifier)) return;
  prepared.canvas.emplace_back(sets, output.low, output.high, crossings, false);
  if (!Canvas::exact(sets)) prepared.canvas.emplace_back(sets, output.low, output.high, crossings, true);
}

double Inference::strength(std::size_t r, const double* degrees) const {
  const Rule& rule = base_.rules[r];
  const std::vector<std::size_t>& steps = steps_[r];
  double w = 0;
  if (conjunctive_[r]) {
    w = 1;
    bool first = true;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      if (rule.antecedent[i].kind != Step::Kind::proposition) continue;
      const double degree = degrees[steps[i]];
      if (degree == 0) return 0;
      w = first ? degree : join(rule.conjunction, w, degree);
      first = false;
    }
  } else {
    double stack[64];
    std::size_t top = 0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      switch (rule.antecedent[i].kind) {
        case Step::Kind::negation: stack[top - 1] = 1 - stack[top - 1]; continue;
        case Step::Kind::proposition: stack[top++] = degrees[steps[i]]; continue;
        case Step::Kind::conjunction:
          stack[top - 2] = join(rule.conjunction, stack[top - 2], stack[top - 1]);
          break;
        case Step::Kind::disjunction:
          stack[top - 2] = join(rule.disjunction, stack[top - 2], stack[top - 1]);
          break;
      }
      --top;
    }
    w = stack[0];
  }
  w *= rule.weight;
  return w >= base_.least_strength ? w : 0;
}

bool Inference::needs(std::size_t r, std::size_t proposition) const {
  if (!conjunctive_[r]) return false;
  for (std::size_t i = 0; i < steps_[r].size(); ++i) {
    const bool is_proposition = base_.rules[r].antecedent[i].kind == Step::Kind::proposition;
    if (is_proposition && steps_[r][i] == proposition) return true;
  }
  return false;
}

bool Inference::weighted(const Output& output, const Prepared& prepared, const double* strengths,
                         const double* inputs, double& out) const {
  double sum = 0;
  double total = 0;
  const auto count = [&](double w, std::size_t term) {
    sum += w * crisp_value(output.terms[term], inputs);
    total += w;
  };
  if (output.merge_terms) {
    std::vector<double> merged(output.terms.size(), 0.0);
    for (const Part& part : prepared.parts)
      merged[part.term] = join(output.aggregation, merged[part.term], strengths[part.rule]);
    for (std::size_t t = 0; t < merged.size(); ++t)
      if (merged[t] > 0) count(merged[t], t);
  } else {
    for (const Part& part : prepared.parts)
      if (strengths[part.rule] > 0) count(part.times * strengths[part.rule], part.term);
  }
  if (!(total > 0)) return false;
  out = output.defuzzifier == Defuzzifier::weighted_average ? sum / total : sum;
  return true;
}

void Inference::activate(const Output& output, const Prepared& prepared, const double* strengths,
                         std::vector<Activated>& out) const {
  out.clear();
  for (const Part& part : prepared.parts) {
    const double w = strengths[part.rule];
    if (!(w > 0)) continue;
    if (output.aggregation == Or::maximum) {
      const auto same = [&](const Activated& a) { return a.set == part.set && a.product == part.product; };
      const auto found = std::find_if(out.begin(), out.end(), same);
      if (found != out.end()) {
        found->strength = std::max(found->strength, w);
        continue;
      }
    }
    out.push_back({part.set, part.product, w, part.times});
  }
}

Answer Inference::answer(std::size_t o, const double* strengths, const double* inputs) const {
  const Output& output = base_.outputs[o];
  const Prepared& prepared = outputs_[o];
  thread_local std::vector<Activated> activated;
  Answer answer{output.silent_value, false};
  if (prepared.canvas.empty()) {
    answer.fired = weighted(output, prepared, strengths, inputs, answer.value);
  } else {
    activate(output, prepared, strengths, activated);
    double strongest = 0;
    for (const Activated& a : activated) strongest = std::max(strongest, a.strength);
    const Canvas& canvas = strongest < kWeak ? prepared.canvas.back() : prepared.canvas.front();
    answer.fired = defuzzify(canvas, output.aggregation, output.defuzzifier, activated, answer.value);
  }
  if (output.clamp) answer.value = std::min(std::max(answer.value, output.low), output.high);
  return answer;
}

std::vector<Answer> Inference::operator()(const std::vector<double>& inputs) const {
  std::vector<double> degrees;
  for (const Proposition& p : propositions_) degrees.push_back(p(base_, inputs[p.input]));
  std::vector<double> strengths;
  for (std::size_t r = 0; r < base_.rules.size(); ++r) strengths.push_back(strength(r, degrees.data()));
  std::vector<Answer> all;
  for (std::size_t o = 0; o < base_.outputs.size(); ++o)
    all.push_back(answer(o, strengths.data(), inputs.data()));
  return all;
}

}  // namespace whisker::rules
