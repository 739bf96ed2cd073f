// SPDX-License-Identifier: MIT
// The one-stage random-observer model of METHODS section 5 and its marginal likelihood.
//
// The location of observer i in condition k (y = log10 of the slope c there) is
//
//     y_ik = x_k' b + u_i + v_ik,   u_i ~ N(0, tau^2),   v_ik ~ N(0, omega^2),
//
// with x_k the condition's row of a design matrix: one column per group for the slope of each
// group, one more for the size exponent, and so on. Answers follow quest's psychometric function
// with slope beta (one per pattern) and a lapse rate shared by all. The effects are integrated out
// by adaptive Gauss-Hermite quadrature (J. C. Pinheiro and D. M. Bates, J. Comput. Graph. Stat. 4,
// 1995), v_ik given u_i inside, u_i outside. Laplace's approximation, one point, is not enough
// here: with 40 trials per cell it is off by .007 per cell, the more the steeper the curve, and
// takes beta and omega 10 % down.
//
// Adaptive points would make the likelihood depend on where they were adapted, so adapt() and
// evaluate() are apart: between two calls of adapt() the points stay, the likelihood is a smooth
// function, and its gradient is exact. An observer's points are not held in units of tau: they
// follow b and tau as those of a normal likelihood would, whose mode and curvature adapt() found.
// Held, thousands of trials keep b and tau near where the points were placed, adapting and climbing
// do not come to an end, and the curvature found between two calls is too large.
//
// Restricted (REML) form: - 1/2 ln det J is added, J the information on b of the linear mixed model
// with the curvatures found by adapt(). It removes the downward bias that tau has in a joint
// maximum with few observers (D. R. Cox and N. Reid, J. R. Stat. Soc. B 49, 1987). Use it for
// estimates and intervals, and the plain form for likelihood ratios between designs.
//
// Priors (weak): ln beta ~ N(ln 3.5, .5^2); lapse ~ Beta(1, 20) on [.001, .15]; the
// floor keeps ln P finite where nobody lapsed. None on b, tau, omega.
//
// tau and omega enter through their squares and the lapse by the squared sine of an angle, so that
// no coordinate has a bound: an optimum at tau = 0 is a stationary point.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/cell_likelihood.h"
#include "records/trial_table.h"

namespace analysis {

inline constexpr double kLapseLimit = 0.15;  ///< upper bound of the lapse rate
inline constexpr double kLapseFloor = 0.001;
inline constexpr double kLapsePriorB = 20;       ///< Beta(1, 20)
inline constexpr double kBetaPriorCentre = 3.5;  ///< Kreuzer section 4.3
inline constexpr double kBetaPriorLnSd = 0.5;    ///< chosen weak: 95 % of the prior in 1.3 .. 9.3

struct ModelCell {
    int condition = 0;  ///< row of the design matrix
    CellTrials trials;
};

struct ModelObserver {
    double gamma = 0.5;       ///< 0.5 in 2AFC; yes/no: the shrunk false-alarm rate
    double lapseGuess = 0.5;  ///< P(yes) on a lapse
    std::vector<ModelCell> cells;
    int copies = 1;  ///< so many observers gave just these answers (draws of a bootstrap), >= 1
};

struct Model {
    std::vector<ModelObserver> observers;
    Eigen::MatrixXd design;      ///< conditions x fixed effects
    std::vector<int> betaIndex;  ///< per condition: which psychometric slope
    int betaCount = 1;
    double criterion = quest::kPaperCriterion;
};

struct ModelParameters {
    Eigen::VectorXd fixed;     ///< b, log10 units
    std::vector<double> beta;  ///< > 0
    double lapse = 0.02;       ///< [kLapseFloor, kLapseLimit]
    double tau = 0.1;          ///< >= 0, log10 units
    double omega = 0.05;       ///< >= 0, log10 units
};

/// The unbounded coordinates in which the likelihood is maximised: b, ln beta, lapse angle, tau,
/// omega.
Eigen::VectorXd toCoordinates(const ModelParameters& parameters);
ModelParameters fromCoordinates(const Eigen::VectorXd& coordinates, const Model& model);

enum class LikelihoodForm { plain, restricted };

/// Points of the quadrature. `fine` is what estimates rest on; `coarse` takes a third of the time
/// and leads the search to within a tenth of a standard error of the maximum.
enum class Quadrature { coarse, fine };

class MarginalLikelihood {
  public:
    /// `model` must outlive this. Every condition and beta index lies in its range.
    explicit MarginalLikelihood(const Model& model);

    /// Fine until told otherwise; adapt() comes next.
    void use(Quadrature quadrature) { quadrature_ = quadrature; }

    /// Places the quadrature points and the curvatures of J for parameters near `coordinates`.
    /// False where an observer's mode is not found.
    bool adapt(const Eigen::VectorXd& coordinates);

    /// ln of the marginal likelihood with priors; fills `gradient` (by coordinate) unless null.
    /// NaN where it cannot be had.
    double evaluate(const Eigen::VectorXd& coordinates, LikelihoodForm form,
                    Eigen::VectorXd* gradient);

    // Of the last adapt() and evaluate():

    /// J.
    const Eigen::MatrixXd& fixedInformation() const { return information_; }
    /// Posterior means of u_i and of y_ik, log10 units; from the last gradient.
    double observerEffect(std::size_t observer) const { return observerEffect_[observer]; }
    double cellLocation(std::size_t observer, std::size_t cell) const {
        return cellLocation_[observer][cell];
    }
    /// REML information on (tau^2, omega^2), and how J falls with each: perTau2 = -dJ / d tau^2.
    struct SpreadInformation {
        Eigen::Matrix2d information;
        Eigen::MatrixXd perTau2, perOmega2;
    };
    SpreadInformation spreadInformation() const;

    int coordinateCount() const;

  private:
    // Where an observer's effects are integrated, in units of their prior sd: u_i = tau U, v_ik =
    // omega N_k, so that tau = 0 is no special case. Given U, N_k is centred at cell[k] +
    // cellSlope[k] (U - observer). Away from where adapt() placed them U's centre and sd are those
    // that a normal likelihood of u_i would give, ln L = score u - information u^2 / 2, whose score
    // falls by rows' (b - b there); N_k is the same.
    struct Points {
        double observer = 0, observerSd = 1;
        double score = 0, information = 0;
        Eigen::VectorXd rows;  // of the design, summed over the observer's cells by information
        std::vector<double> cell, cellSlope, cellSd;
        std::vector<double> curvature;  // w_k = -l'' at the mode, at least 0
    };
    struct Mixed;

    double location(std::size_t observer, std::size_t cell, const ModelParameters& at, double bigU,
                    double bigN) const;
    Curve curve(std::size_t observer, int condition, const ModelParameters& at) const;
    bool findMode(std::size_t observer, const ModelParameters& at);
    void placePoints(std::size_t observer, const ModelParameters& at);
    double integrate(std::size_t observer, const ModelParameters& at, Eigen::VectorXd* gradient);
    Mixed mixed(std::size_t observer, const ModelParameters& at) const;
    double restriction(const ModelParameters& at, Eigen::VectorXd* gradient);

    // Means over the inner points of a cell, at one outer point.
    struct Mean {
        double y = 0, perY = 0, perYN = 0, perLnBeta = 0, perLapse = 0;
    };

    const Model& model_;
    Quadrature quadrature_ = Quadrature::fine;
    std::vector<Points> points_;
    Eigen::VectorXd adaptedFixed_;  // b where adapt() placed them
    CellPoints cellPoints_;
    // Of integrate(), kept between calls for their memory.
    std::vector<double> logOuter_, bigU_, weight_, bigN_, y_;
    std::vector<Mean> means_;
    std::vector<double> observerEffect_;
    std::vector<std::vector<double>> cellLocation_;
    Eigen::MatrixXd information_;
    ModelParameters last_;
};

}  // namespace analysis
